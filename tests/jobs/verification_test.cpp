// Blocks that a second node renders, and what happens to nodes that render wrongly.
#include "farm/jobs/cross_check.h"
#include "farm/jobs/strangeness.h"
#include "tests/jobs/job_fixture.h"

using namespace antipode;
using namespace antipode::test;

namespace {

class VerificationTest : public JobTest {
protected:
    void startVerified(uint64_t iterations) {
        start({.iterations = iterations, .verifyFraction = 1, .leastPatienceSeconds = 10});
    }
    /// Lets all nodes that have a lease render it, honestly but for the liars, until nothing happens any more.
    void run(const std::vector<std::string>& liars = {}) {
        for (int i = 0; i < 1000; ++i) {
            tick();
            bool any = false;
            for (auto& [name, port] : ports_) {
                if (port.granted.empty()) continue;
                any = true;
                const Lease lease = take(name);
                const BlockResult result = resultOf(job_, lease.range, std::ranges::count(liars, name) != 0);
                now_ += 0.1;
                if (coordinator_->wanted(ids_[name], lease.id, lease.range, result.sha256, now_))
                    coordinator_->deliver(ids_[name], lease.id, result, now_);
            }
            if (!any) return;
        }
        FAIL() << "it does not end";
    }
    void deliverZeros(const std::string& name, const Lease& lease) {
        BlockResult result = resultOf(job_, lease.range);
        std::ranges::fill(result.sums.values, 0);
        result.sha256 = result.sums.sha256();
        coordinator_->deliver(ids_[name], lease.id, result, now_);
    }
};

}  // namespace

TEST(CrossCheck, DrawsTheShareThatIsAskedForByTheSeed) {
    const CrossCheck none(0, 1), all(1, 1), some(0.1, 1), other(0.1, 2);
    int drawn = 0, both = 0;
    for (uint64_t first = 0; first < 100000; ++first) {
        EXPECT_FALSE(none.drawn(first));
        EXPECT_TRUE(all.drawn(first));
        drawn += some.drawn(first);
        both += some.drawn(first) && other.drawn(first);
    }
    // Binomial: 10000 ± 95 and 1000 ± 31; these are five standard deviations.
    EXPECT_NEAR(drawn, 10000, 475);
    EXPECT_NEAR(both, 1000, 157);
}

TEST_F(VerificationTest, TwoHonestNodesAgree) {
    startVerified(20);
    add("a");
    add("b");
    run();
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(coordinator_->hashMismatches(), 0u);
    EXPECT_EQ(messages(), "");
    expectExact();
}

TEST_F(VerificationTest, IsNotCompleteBeforeTheSecondRendering) {
    startVerified(1);
    add("a");
    add("b");
    tick();
    const Lease lease = take("a");
    EXPECT_TRUE(idle("b"));
    EXPECT_EQ(deliver("a", lease.id, lease.range), Verdict::Committed);
    EXPECT_FALSE(coordinator_->complete());
    tick();
    EXPECT_TRUE(idle("a")) << "nobody checks itself";
    const Lease check = take("b");
    EXPECT_EQ(check.range, lease.range);
    EXPECT_FALSE(coordinator_->wanted(ids_["b"], check.id, check.range, resultOf(job_, check.range).sha256, now_));
    EXPECT_TRUE(coordinator_->complete());
}

TEST_F(VerificationTest, AChecksWholeResultIsComparedToo) {
    startVerified(1);
    add("a");
    add("b");
    tick();
    const Lease lease = take("a");
    deliver("a", lease.id, lease.range);
    tick();
    const Lease check = take("b");
    EXPECT_EQ(deliver("b", check.id, check.range), Verdict::NotNeeded);
    EXPECT_TRUE(coordinator_->complete());
}

TEST_F(VerificationTest, ALiarIsFoundAndAllItsWorkIsRenderedAgain) {
    for (const char* liar : {"a", "b", "c"}) {
        SCOPED_TRACE(liar);
        ports_.clear();
        startVerified(40);
        for (const char* name : {"a", "b", "c"}) add(name, 2);
        run({liar});
        EXPECT_TRUE(coordinator_->complete());
        EXPECT_EQ(status(liar).state, NodeStatus::State::Quarantined);
        EXPECT_EQ(status(liar).committed, 0u);
        EXPECT_GE(coordinator_->hashMismatches(), 1u);
        EXPECT_EQ(coordinator_->committed(), IterationSet({{0, 40}}));
        expectExact();
    }
}

TEST_F(VerificationTest, WaitsForAThirdNodeAndSaysSo) {
    startVerified(1);
    add("a");
    add("b");
    run({"a"});
    EXPECT_FALSE(coordinator_->complete());
    const std::string said = messages();
    EXPECT_NE(said.find("disagree on iteration 1"), std::string::npos) << said;
    EXPECT_NE(said.find("waits for a further node of class 'class'"), std::string::npos) << said;
    tick(10);
    EXPECT_EQ(messages(), "") << "once";
    add("other", 1, "another class");
    run({"a"});
    EXPECT_FALSE(coordinator_->complete());
    add("c");
    run({"a"});
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(status("a").state, NodeStatus::State::Quarantined);
    expectExact();
}

TEST_F(VerificationTest, WhoIsInQuarantineStaysThere) {
    startVerified(8);
    for (const char* name : {"a", "b", "c"}) add(name, 2);
    run({"a"});
    coordinator_->removeNode(ids_["a"], now_);
    add("a");
    EXPECT_EQ(status("a").state, NodeStatus::State::Quarantined);
    tick();
    EXPECT_TRUE(idle("a"));
}

TEST_F(VerificationTest, ResultsOfTheQuarantinedAreRefused) {
    startVerified(64);
    for (const char* name : {"b", "c"}) add(name);
    add("a", 4);
    tick();
    // One of its leases is decided upon while it holds the others.
    const Lease first = take("a"), kept = take("a");
    deliver("a", first.id, first.range, true);
    std::vector<std::string> honest{"b", "c"};
    for (int i = 0; i < 20 && status("a").state != NodeStatus::State::Quarantined; ++i) {
        for (const std::string& name : honest)
            if (!idle(name)) render(name, take(name), 1);
        tick();
    }
    ASSERT_EQ(status("a").state, NodeStatus::State::Quarantined);
    EXPECT_TRUE(port("a").isTruncated(kept.id));
    EXPECT_EQ(deliver("a", kept.id, kept.range), Verdict::Rejected);
    expectExact();
}

TEST_F(VerificationTest, OneNodeAloneEndsInAFailure) {
    startVerified(4);
    add("a");
    add("b", 1, "another class");
    run();
    EXPECT_EQ(coordinator_->committed().count(), 4u);
    EXPECT_FALSE(coordinator_->complete());
    EXPECT_NE(messages().find("waits for a further node of class 'class' to verify"), std::string::npos);
    tick(59);
    EXPECT_EQ(coordinator_->failure(), "");
    tick(2);
    EXPECT_NE(coordinator_->failure().find("The image is not verified"), std::string::npos) << coordinator_->failure();
    EXPECT_FALSE(coordinator_->complete());
    add("c");
    tick();
    EXPECT_TRUE(idle("c")) << "it is over";
}

TEST_F(VerificationTest, ADisputeWithoutAThirdNodeEndsInAFailure) {
    startVerified(1);
    add("a");
    add("b");
    run({"a"});
    tick(61);
    EXPECT_NE(coordinator_->failure().find("which of two nodes renders wrongly"), std::string::npos);
    EXPECT_FALSE(coordinator_->complete());
}

// A node that comes in time makes the checks, and the time for the next wait begins anew.
TEST_F(VerificationTest, PatienceBeginsAnewWithEachNode) {
    startVerified(2);
    add("a");
    run();
    tick(50);
    add("b");
    tick();
    coordinator_->removeNode(ids_["b"], now_);
    tick(50);
    EXPECT_EQ(coordinator_->failure(), "");
    ports_["b"].granted.clear();
    add("b");
    run();
    EXPECT_TRUE(coordinator_->complete());
}

// A server that answered zeros at once had taken a whole job before the second was ready.
TEST_F(VerificationTest, ZerosBeforeTheSecondNodeIsReadyAreNotTheImage) {
    start({.iterations = 8, .verifyFraction = 1e-9});
    add("broken");
    for (tick(); coordinator_->committed().count() < 8; tick()) {
        const Lease lease = take("broken");
        deliverZeros("broken", lease);
    }
    EXPECT_FALSE(coordinator_->complete()) << "its first block is not checked";
    add("b");
    add("c");
    run();
    EXPECT_EQ(status("broken").state, NodeStatus::State::Quarantined);
    EXPECT_TRUE(coordinator_->complete());
    expectExact();
}

TEST_F(VerificationTest, ABlackBlockIsCheckedWhateverIsDrawn) {
    start({.iterations = 3, .verifyFraction = 1e-9});
    for (const char* name : {"a", "b", "c"}) add(name);
    tick();
    const Lease own = take("a");
    std::map<std::string, Lease> others{{"b", take("b")}, {"c", take("c")}};
    for (auto& [name, lease] : others) deliver(name, lease.id, lease.range);
    deliverZeros("a", own);
    run();
    EXPECT_EQ(status("a").state, NodeStatus::State::Quarantined);
    EXPECT_TRUE(coordinator_->complete());
    expectExact();
}

TEST_F(VerificationTest, WithoutItABlackBlockIsSaid) {
    start({.iterations = 2});
    add("a");
    tick();
    const Lease lease = take("a");
    deliver("a", lease.id, lease.range);
    tick();
    const Lease black = take("a");
    deliverZeros("a", black);
    EXPECT_NE(messages().find("What node a rendered in iteration 2 is black: --verify"), std::string::npos);
    EXPECT_TRUE(coordinator_->complete());
}

TEST(Strangeness, TellsWhatHonestImagesRarelyAre) {
    const JobDefinition job = smallJob();
    const auto sums = [&](int64_t value, uint64_t iterations) {
        FilmSums film = fakeSums(job.settings, {{0, iterations}});
        std::ranges::fill(film.values, value * int64_t(iterations));
        return film;
    };
    const auto beside = [&](FilmSums block, const FilmSums& rest) {
        FilmSums all = rest;
        for (size_t i = 0; i < all.values.size(); ++i) all.values[i] += block.values[i];
        all.iterations += block.iterations;
        return strangeness(block, all);
    };
    EXPECT_EQ(beside(sums(10, 2), sums(10, 5)), "");
    EXPECT_EQ(beside(sums(39, 2), sums(10, 5)), "");
    EXPECT_EQ(beside(sums(41, 2), sums(10, 5)), "is more than four times as bright as the rest");
    EXPECT_EQ(beside(sums(10, 2), sums(39, 5)), "");
    EXPECT_EQ(beside(sums(10, 2), sums(41, 5)), "is less than a quarter as bright as the rest");
    EXPECT_EQ(strangeness(sums(41, 2), sums(41, 2)), "") << "there is no rest";
    FilmSums negative = sums(10, 2);
    negative.values[3] = -1;
    EXPECT_EQ(beside(negative, sums(10, 5)), "is below 0");
    negative.events.at(EventSource::Film, EventKind::Negative) = 1;
    EXPECT_EQ(beside(negative, sums(10, 5)), "");
    EXPECT_TRUE(isBlack(sums(0, 2)));
    EXPECT_TRUE(isBlack({}));
    FilmSums guides = sums(0, 2);
    guides.values.back() = 5;  // an albedo is no light
    EXPECT_TRUE(isBlack(guides));
    guides.values.front() = 1;
    EXPECT_FALSE(isBlack(guides));
}

TEST_F(VerificationTest, WhoComesLaterChecksWhatCameBefore) {
    startVerified(2);
    add("a");
    tick();
    const Lease first = take("a");
    deliver("a", first.id, first.range);
    add("b");
    run();
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(messages(), "");
}

TEST_F(VerificationTest, ChecksAreMadeHoweverSlowly) {
    startVerified(200);
    add("fast");
    for (tick(); coordinator_->committed().count() < 200; tick()) render("fast", take("fast"), 0.05);
    add("slow");
    for (tick(); !coordinator_->complete(); tick()) {
        ASSERT_EQ(coordinator_->failure(), "");
        render("slow", take("slow"), 20);
    }
    EXPECT_EQ(messages().find("not verified"), std::string::npos);
    expectExact();
}

TEST_F(VerificationTest, AChecksNodeMayLeave) {
    startVerified(1);
    add("a");
    add("b");
    tick();
    const Lease lease = take("a");
    deliver("a", lease.id, lease.range);
    tick();
    coordinator_->removeNode(ids_["b"], now_);
    tick();
    EXPECT_FALSE(coordinator_->complete());
    add("c");
    run();
    EXPECT_TRUE(coordinator_->complete());
}

TEST_F(VerificationTest, DeliveringLessDoesNotEvadeACheck) {
    startVerified(64);
    add("a");
    add("b");
    tick();
    Lease lease = take("a");
    while (lease.range.count < 2) {
        EXPECT_EQ(render("a", lease, 0.1), Verdict::Committed);
        tick();
        lease = take("a");
    }
    const IterationRange part{lease.range.first, 1};
    EXPECT_EQ(deliver("a", lease.id, part, true), Verdict::Committed);
    bool checked = false;
    while (!checked) {
        ASSERT_FALSE(idle("b")) << "it has not been checked";
        lease = take("b");
        checked = lease.range == part;
        render("b", lease, 0.1);
        tick();
    }
    EXPECT_EQ(coordinator_->hashMismatches(), 1u);
}

TEST_F(VerificationTest, ACheckpointIsTrusted) {
    Checkpoint checkpoint;
    checkpoint.job = job_;
    checkpoint.committed.add({0, 8});
    checkpoint.sums = fakeSums(job_.settings, {{0, 8}});
    checkpoint.sums.events = eventsOf(8);
    checkpoint.statistics.rays = 8;
    start({.iterations = 16, .verifyFraction = 1}, checkpoint);
    for (const char* name : {"a", "b", "c"}) add(name, 2);
    run({"b"});
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(status("b").state, NodeStatus::State::Quarantined);
    expectExact();
}
