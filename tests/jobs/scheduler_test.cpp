// Who gets what and when, on a clock that the test moves.
#include "farm/jobs/scheduler.h"

#include "tests/jobs/job_fixture.h"
#include "tests/support/dyadic.h"

using namespace antipode;
using namespace antipode::test;

namespace {

NodeEntry nodeWith(double rate, uint64_t largest) {
    NodeEntry node;
    node.speed.observe(100, 100 / rate);
    node.largestBlock = largest;
    return node;
}

class SchedulerTest : public JobTest {
protected:
    /// Renders what the node is granted until its blocks have that size.
    void warmUp(const std::string& name, double secondsPerIteration, uint64_t size) {
        for (int i = 0; i < 40; ++i) {
            tick();
            if (port(name).granted.front().range.count >= size) return;
            EXPECT_EQ(render(name, take(name), secondsPerIteration), Verdict::Committed);
        }
        FAIL() << name << " never gets a block of " << size;
    }
};

}  // namespace

TEST(BlockSize, FillsTheTargetTimeWithAPowerOfTwo) {
    EXPECT_EQ(blockSize(nodeWith(10, 1000), 10, 1 << 20, 4), 32u);
    EXPECT_EQ(blockSize(nodeWith(0.1, 1000), 0.1, 1 << 20, 4), 1u);
}

TEST(BlockSize, IsOneWhereTheSpeedIsUnknown) { EXPECT_EQ(blockSize(NodeEntry(), 10, 1 << 20, 4), 1u); }

TEST(BlockSize, GrowsByNoMoreThanTwo) { EXPECT_EQ(blockSize(nodeWith(1000, 4), 1000, 1 << 20, 4), 8u); }

TEST(BlockSize, IsHalfOfTheNodesShareOfTheRest) {
    EXPECT_EQ(blockSize(nodeWith(10, 1000), 20, 64, 4), 16u);
    EXPECT_EQ(blockSize(nodeWith(10, 1000), 20, 3, 4), 1u);
    EXPECT_EQ(blockSize(nodeWith(10, 1000), 20, 0, 4), 1u);
}

TEST(BlockSize, HasABoundWhateverTheClockSays) {
    EXPECT_EQ(blockSize(nodeWith(1e9, uint64_t(1) << 40), 1e9, uint64_t(1) << 60, 4), 65536u);
}

TEST_F(SchedulerTest, FirstLeaseIsOneIteration) {
    start({.iterations = 1000});
    add("a");
    add("b");
    tick();
    EXPECT_EQ(take("a").range, (IterationRange{0, 1}));
    EXPECT_EQ(take("b").range, (IterationRange{1, 1}));
}

TEST_F(SchedulerTest, BlocksGrowWithoutGapsAndShrinkTowardsTheEnd) {
    start({.iterations = 1000, .targetSeconds = 4});
    add("a");
    std::vector<uint64_t> sizes;
    while (tick(), !coordinator_->complete()) {
        const Lease lease = take("a");
        EXPECT_TRUE(test::isDyadic(lease.range));
        EXPECT_EQ(coordinator_->committed().prefix(), lease.range.first);
        sizes.push_back(lease.range.count);
        ASSERT_EQ(render("a", lease, 0.05), Verdict::Committed);
    }
    EXPECT_EQ(*std::ranges::max_element(sizes), 64u);
    EXPECT_EQ(sizes.back(), 1u);
    EXPECT_LT(sizes.size(), 40u);
    expectExact();
}

TEST_F(SchedulerTest, BlocksTakeLongerWhereResultsWouldComeTooFast) {
    // Two nodes, one result in eight seconds to be merged: sixteen seconds of 0.05 s an iteration.
    start({.iterations = 100000, .targetSeconds = 4, .mostResultsPerSecond = 0.125});
    add("a");
    add("b");
    warmUp("a", 0.05, 256);
    EXPECT_EQ(render("a", take("a"), 0.05), Verdict::Committed);
    tick();
    EXPECT_EQ(take("a").range.count, 256u) << "no more than the target time";
}

TEST_F(SchedulerTest, ANodeHoldsNoMoreThanItsDepth) {
    start({});
    add("a", 3);
    tick();
    tick();
    EXPECT_EQ(port("a").granted.size(), 3u);
    EXPECT_EQ(coordinator_->outstanding(), 3u);
    render("a", take("a"), 1);
    tick();
    EXPECT_EQ(port("a").granted.size(), 3u);
}

TEST_F(SchedulerTest, AnAbsurdDepthIsBounded) {
    start({});
    add("a", 4000000000u);
    tick();
    EXPECT_EQ(coordinator_->outstanding(), 16u);
}

TEST_F(SchedulerTest, RetiredNodesGetNothingButMayDeliver) {
    start({.iterations = 10});
    add("a");
    tick();
    coordinator_->retireNode(ids_["a"], now_);
    EXPECT_EQ(render("a", take("a"), 1), Verdict::Committed);
    tick();
    EXPECT_TRUE(idle("a"));
    coordinator_->removeNode(ids_["a"], now_);
    add("a");
    tick();
    EXPECT_FALSE(idle("a"));
}

TEST_F(SchedulerTest, ALeaseExpiresAndItsLateResultIsWelcome) {
    start({.iterations = 1, .leastPatienceSeconds = 10, .firstPatienceSeconds = 120});
    add("a");
    tick();
    const Lease lease = take("a");
    tick(120);
    EXPECT_EQ(status("a").state, NodeStatus::State::Rendering);
    tick(1);
    EXPECT_EQ(status("a").state, NodeStatus::State::Stalled);
    EXPECT_EQ(status("a").lost, 1u);
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_NE(messages().find("Node a makes no progress"), std::string::npos);
    tick(100);
    EXPECT_TRUE(idle("a")) << "a stalled node gets nothing";
    EXPECT_EQ(deliver("a", lease.id, lease.range), Verdict::Committed);
    EXPECT_NE(messages().find("Node a makes progress again"), std::string::npos);
    EXPECT_EQ(status("a").state, NodeStatus::State::Idle);
    EXPECT_EQ(status("a").lost, 0u);
    EXPECT_TRUE(coordinator_->complete());
}

TEST_F(SchedulerTest, AnExpiredBlockGoesToAnother) {
    start({.iterations = 1});
    add("a");
    tick();
    const Lease late = take("a");
    tick(121);
    add("b");
    tick();
    EXPECT_EQ(take("b").range, late.range);
    EXPECT_EQ(deliver("a", late.id, late.range), Verdict::Committed);
    EXPECT_EQ(port("b").truncated.size(), 1u);
}

TEST_F(SchedulerTest, ProgressOfAnExpiredLeaseTakesItBack) {
    start({.iterations = 64, .patience = 8, .leastPatienceSeconds = 10});
    add("a");
    warmUp("a", 1, 2);
    const Lease lease = take("a");
    tick(11);
    EXPECT_EQ(status("a").state, NodeStatus::State::Stalled);
    coordinator_->progress(ids_["a"], lease.id, 1, now_);
    EXPECT_EQ(status("a").state, NodeStatus::State::Rendering);
    EXPECT_NEAR(status("a").iterationsPerSecond, 1, 1e-9) << "the pause says nothing about the speed";
    add("b");
    tick();
    EXPECT_FALSE(IterationSet({lease.range}).intersects(take("b").range));
    EXPECT_EQ(deliver("a", lease.id, lease.range), Verdict::Committed);
    expectExact();
}

TEST_F(SchedulerTest, RepeatedReportsAreNoProgress) {
    start({.iterations = {}, .leastPatienceSeconds = 10});
    add("a");
    warmUp("a", 1, 4);
    const Lease lease = take("a");
    coordinator_->progress(ids_["a"], lease.id, 1, now_ += 1);
    for (int i = 0; i < 11; ++i) coordinator_->progress(ids_["a"], lease.id, 1, now_ += 1);
    coordinator_->progress(ids_["a"], lease.id, 1000, now_);
    coordinator_->progress(ids_["a"], lease.id + 1000, 1, now_);
    tick();
    EXPECT_EQ(status("a").state, NodeStatus::State::Stalled);
}

TEST_F(SchedulerTest, AQueuedLeaseIsNotLate) {
    start({.iterations = {}, .leastPatienceSeconds = 10});
    add("a", 2);
    tick();
    Lease first = take("a");
    for (int i = 0; i < 6; ++i) {
        render("a", first, 9);
        tick();
        first = take("a");
    }
    const Lease second = port("a").granted.front();
    for (uint64_t i = 1; i <= first.range.count; ++i) {
        tick(9);
        coordinator_->progress(ids_["a"], first.id, i, now_);
    }
    tick(60);
    EXPECT_EQ(status("a").state, NodeStatus::State::Rendering) << "8 times 9 seconds is the patience";
    tick(20);
    EXPECT_EQ(status("a").state, NodeStatus::State::Stalled);
    EXPECT_EQ(deliver("a", first.id, first.range), Verdict::Committed) << "which is on its way for 80 seconds";
    EXPECT_EQ(deliver("a", second.id, second.range), Verdict::Committed);
}

TEST_F(SchedulerTest, TheWholeQueueExpiresWithItsHead) {
    start({.iterations = 2});
    add("a", 2);
    tick();
    tick(121);
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    add("b", 2);
    tick();
    EXPECT_EQ(port("b").granted.size(), 2u);
}

TEST_F(SchedulerTest, ATransferDoesNotExpireWhilePartsCome) {
    start({.iterations = 1, .firstPatienceSeconds = 120});
    add("a");
    tick();
    const Lease lease = take("a");
    EXPECT_TRUE(coordinator_->wanted(ids_["a"], lease.id, lease.range, std::string(64, '0'), now_));
    for (int i = 0; i < 10; ++i) {
        tick(100);
        coordinator_->progress(ids_["a"], lease.id, 1, now_);
    }
    EXPECT_EQ(coordinator_->outstanding(), 1u);
    tick(121);
    EXPECT_EQ(coordinator_->outstanding(), 0u);
}

TEST_F(SchedulerTest, AnIdleNodeDuplicatesWhatItWouldWin) {
    start({.iterations = 4});
    add("slow");
    add("fast");
    tick();
    const Lease first = take("slow");
    render("fast", take("fast"), 0.01);
    now_ += 1 - 0.01;
    EXPECT_EQ(render("slow", first, 0), Verdict::Committed);
    tick();
    const Lease slow = take("slow"), fast = take("fast");
    render("fast", fast, 0.01);
    tick();
    const Lease duplicate = take("fast");
    EXPECT_EQ(duplicate.range, slow.range);
    EXPECT_NE(duplicate.id, slow.id);
    EXPECT_FALSE(port("slow").isTruncated(slow.id));
    render("fast", duplicate, 0.01);
    EXPECT_TRUE(port("slow").isTruncated(slow.id)) << "the loser stops at once";
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_FALSE(coordinator_->wanted(ids_["slow"], slow.id, slow.range, resultOf(job_, slow.range).sha256, now_));
    EXPECT_EQ(coordinator_->hashMismatches(), 0u);
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    expectExact();
}

TEST_F(SchedulerTest, ASlowNodeDoesNotDuplicate) {
    start({.iterations = 3});
    add("slow");
    add("fast");
    tick();
    render("fast", take("fast"), 0.1);
    render("slow", take("slow"), 5);
    coordinator_->removeNode(ids_["slow"], now_);
    tick();
    add("slow");
    tick();
    EXPECT_TRUE(idle("slow"));
    EXPECT_EQ(port("fast").granted.size(), 1u);
}

TEST_F(SchedulerTest, ThereIsOneDuplicateAtMost) {
    start({.iterations = 1, .leastPatienceSeconds = 10});
    add("a");
    tick();
    add("b");
    tick(9);
    EXPECT_TRUE(idle("b")) << "nothing is known of anybody's speed";
    tick(2);
    EXPECT_FALSE(idle("b")) << "which has lasted too long";
    add("c");
    tick(50);
    EXPECT_TRUE(idle("c"));
}

TEST_F(SchedulerTest, WhatADuplicateStillHoldsIsNotFree) {
    start({.iterations = 1, .leastPatienceSeconds = 10});
    add("a");
    tick();
    add("b");
    tick(11);
    coordinator_->removeNode(ids_["a"], now_);
    add("c");
    tick();
    EXPECT_TRUE(idle("c"));
    const Lease lease = take("b");
    EXPECT_EQ(render("b", lease, 1), Verdict::Committed);
    EXPECT_TRUE(coordinator_->complete());
}

TEST_F(SchedulerTest, DuplicatesThatDifferAreReported) {
    start({.iterations = 1, .leastPatienceSeconds = 10});
    add("a");
    tick();
    add("b");
    tick(11);
    const Lease a = take("a"), b = take("b");
    EXPECT_EQ(render("a", a, 1, {}, true), Verdict::Committed);
    EXPECT_EQ(render("b", b, 1), Verdict::NotNeeded);
    EXPECT_EQ(coordinator_->hashMismatches(), 1u);
    EXPECT_NE(messages().find("Nodes a and b disagree on iteration 1"), std::string::npos);
}

TEST_F(SchedulerTest, DuplicatesOfOtherClassesAreNotCompared) {
    start({.iterations = 1, .leastPatienceSeconds = 10});
    add("a");
    tick();
    add("b", 1, "other");
    tick(11);
    const Lease a = take("a"), b = take("b");
    render("a", a, 1, {}, true);
    EXPECT_EQ(render("b", b, 1), Verdict::NotNeeded);
    EXPECT_EQ(coordinator_->hashMismatches(), 0u);
}

TEST_F(SchedulerTest, AFarmWithOneSlowNodeIsHardlySlowerThanWithoutIt) {
    const auto run = [&](bool withSlowNode) {
        now_ = 0;
        ports_.clear();
        start({.iterations = 2000, .targetSeconds = 2});
        struct Node {
            std::string name;
            double perIteration;
            Lease lease{};
            uint64_t done = 0;
            double due = 0;
        };
        std::vector<Node> farm{{"a", 0.02}, {"b", 0.02}, {"c", 0.02}};
        if (withSlowNode) farm.push_back({"slow", 1.0});
        for (const Node& node : farm) add(node.name);
        while (!coordinator_->complete() && now_ < 1000) {
            tick(0.005);
            for (Node& node : farm) {
                for (; !node.lease.id && !idle(node.name); node.due = now_ + node.perIteration, node.done = 0)
                    node.lease = take(node.name);
                if (!node.lease.id || now_ < node.due) continue;
                coordinator_->progress(ids_[node.name], node.lease.id, ++node.done, now_);
                node.due += node.perIteration;
                if (node.done < node.lease.range.count && !port(node.name).isTruncated(node.lease.id)) continue;
                deliver(node.name, node.lease.id, {node.lease.range.first, node.done});
                node.lease = {};
            }
        }
        EXPECT_TRUE(coordinator_->complete());
        return now_;
    };
    const double without = run(false), with = run(true);
    EXPECT_LT(without, 1.1 * 2000 * 0.02 / 3);
    EXPECT_LT(with, 1.3 * without);
    RecordProperty("secondsWithout", std::to_string(without));
    RecordProperty("secondsWith", std::to_string(with));
}
