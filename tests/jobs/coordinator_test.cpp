// What is committed, what is not, and how a job ends.
#include <array>
#include <random>

#include "renderengine/error_classes.h"
#include "tests/film/expect_error.h"
#include "tests/jobs/job_fixture.h"

using namespace antipode;
using namespace antipode::test;

namespace {

class CoordinatorTest : public JobTest {
protected:
    /// The node's next lease, of at least two iterations.
    Lease largerLease(const std::string& name) {
        for (int i = 0; i < 10; ++i) {
            tick();
            const Lease lease = take(name);
            if (lease.range.count >= 2) return lease;
            EXPECT_EQ(render(name, lease, 0.5), Verdict::Committed);
        }
        ADD_FAILURE() << "no lease of two iterations";
        return {};
    }
    void expectRejected(const Lease& lease, BlockResult result, uint32_t others = 0) {
        const uint64_t before = coordinator_->committed().count();
        EXPECT_EQ(coordinator_->deliver(ids_["a"], lease.id, std::move(result), now_), Verdict::Rejected);
        EXPECT_EQ(coordinator_->committed().count(), before);
        EXPECT_EQ(coordinator_->outstanding(), others);
        expectExact();
    }
};

}  // namespace

TEST_F(CoordinatorTest, HasNoSumsBeforeTheFirstResult) {
    start({.iterations = 4});
    EXPECT_TRUE(coordinator_->sums().values.empty());
    EXPECT_EQ(coordinator_->sums().iterations, 0u);
    EXPECT_FALSE(coordinator_->complete());
}

TEST_F(CoordinatorTest, CommitsEachIterationOnce) {
    start({.iterations = 1});
    add("a");
    tick();
    const Lease lease = take("a");
    EXPECT_EQ(deliver("a", lease.id, lease.range), Verdict::Committed);
    EXPECT_EQ(deliver("a", lease.id, lease.range), Verdict::NotNeeded) << "sent again";
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(status("a").committed, 1u);
    expectExact();
}

TEST_F(CoordinatorTest, LeasesStayWithinARunWhereTheImageIsInClasses) {
    job_.settings.residueClasses.reset();
    start({.iterations = 200, .errorClasses = true});
    add("a", 2);
    add("b", 1);
    uint64_t largest = 0;
    while (!coordinator_->complete()) {
        tick();
        for (const char* name : {"a", "b"}) {
            if (idle(name)) continue;
            const Lease lease = take(name);
            ASSERT_TRUE(errorRun(lease.range.first).contains(lease.range)) << lease.range.first;
            largest = std::max(largest, lease.range.count);
            // Every third block of "b" ends early.
            const bool early = *name == 'b' && lease.range.count > 1 && lease.range.first % 3 == 0;
            ASSERT_EQ(render(name, lease, 0.01, early ? lease.range.count / 2 : lease.range.count), Verdict::Committed);
        }
    }
    EXPECT_GE(largest, 8u) << "not single iterations all along";
    expectExact();
}

TEST_F(CoordinatorTest, ClassesAreThoseOfTheIterationsWhoeverRenders) {
    job_.settings.residueClasses.reset();
    FilmSums expected;
    for (uint64_t i = 0; i < 64; ++i) {
        const FilmSums one = resultOf(job_, {i, 1}).sums;
        if (i == 0)
            expected = inErrorClasses(one, 0);
        else
            expected.merge(one, errorClass(i));
    }
    for (const double verify : {0.0, 1.0}) {
        start({.iterations = 64, .errorClasses = true, .verifyFraction = verify});
        std::mt19937_64 random(5);
        for (const char* name : {"a", "b", "c"}) add(name, 2);
        while (!coordinator_->complete()) {
            tick();
            const char* name = std::array{"a", "b", "c"}[random() % 3];
            if (idle(name)) continue;
            const Lease lease = take(name);
            render(name, lease, name[0] == 'a' ? 0.01 : 0.3);
        }
        EXPECT_EQ(coordinator_->sums().sha256(), expected.sha256());
        EXPECT_EQ(coordinator_->sums().residueIterations, expected.residueIterations);
    }
}

TEST_F(CoordinatorTest, EventsTravel) {
    start({.iterations = 1});
    add("a");
    tick();
    const Lease lease = take("a");
    BlockResult result = resultOf(job_, lease.range);
    result.sums.events.at(EventSource::Splat, EventKind::NonFinite) = 3;
    EXPECT_EQ(coordinator_->deliver(ids_["a"], lease.id, result, now_), Verdict::Committed);
    EXPECT_EQ(coordinator_->sums().events, result.sums.events);
}

TEST_F(CoordinatorTest, APartLeavesTheRestToOthers) {
    start({.iterations = 64});
    add("a");
    const Lease lease = largerLease("a");
    EXPECT_EQ(render("a", lease, 0.5, 1), Verdict::Committed);
    tick();
    EXPECT_EQ(take("a").range.first, lease.range.first + 1);
    expectExact();
}

TEST_F(CoordinatorTest, RejectsWhatIsNotAPrefixOfItsLease) {
    const auto attempt = [&](const char* what, auto&& change) {
        SCOPED_TRACE(what);
        start({.iterations = 64});
        ports_.clear();
        add("a");
        const Lease lease = largerLease("a");
        IterationRange range = lease.range;
        change(range);
        const IterationRange small{range.first, std::min<uint64_t>(range.count, 100)};
        BlockResult result = resultOf(job_, small);
        result.range = range;
        result.sums.iterations = range.count;
        expectRejected(lease, result);
        tick();
        EXPECT_EQ(take("a").range, lease.range) << "it is back in the pool";
    };
    attempt("too many", [](IterationRange& range) { ++range.count; });
    attempt("none", [](IterationRange& range) { range.count = 0; });
    attempt("not from the first on", [](IterationRange& range) { ++range.first, --range.count; });
    attempt("overflow", [](IterationRange& range) { range.count = ~uint64_t(0); });
}

TEST_F(CoordinatorTest, RejectsSumsOfAnotherShape) {
    const auto attempt = [&](const char* what, auto&& change) {
        SCOPED_TRACE(what);
        start({.iterations = 64});
        ports_.clear();
        add("a");
        const Lease lease = largerLease("a");
        BlockResult result = resultOf(job_, lease.range);
        change(result.sums);
        expectRejected(lease, result);
        EXPECT_NE(messages().find("A result of node a was refused"), std::string::npos);
    };
    attempt("width", [](FilmSums& sums) { sums.layout.width = 1, sums.layout.height = 2; });
    attempt("size", [](FilmSums& sums) { sums.values.push_back(0); });
    attempt("scale", [](FilmSums& sums) { ++sums.layout.layers[0].scaleExponent; });
    attempt("iterations", [](FilmSums& sums) { ++sums.iterations; });
    attempt("a bomb", [](FilmSums& sums) { sums.values[1] = -(int64_t(1) << 62) - 1; });
}

TEST_F(CoordinatorTest, TheClientsScaleCountsNotTheFirstResults) {
    job_.film = fakeSums(job_.settings, {}).layout;
    start({.iterations = 64});
    add("a"), add("b");
    tick();
    const Lease first = take("a"), right = take("b");
    BlockResult other = resultOf(job_, first.range);
    ++other.sums.layout.layers[0].scaleExponent;
    expectRejected(first, other, 1);
    EXPECT_EQ(deliver("b", right.id, right.range), Verdict::Committed);
    for (int i = 0; i < 2; ++i) {
        EXPECT_NE(status("a").state, NodeStatus::State::Quarantined);
        tick();
        const Lease again = take("a");
        other = resultOf(job_, again.range);
        ++other.sums.layout.layers[0].scaleExponent;
        EXPECT_EQ(coordinator_->deliver(ids_["a"], again.id, other, now_), Verdict::Rejected);
    }
    EXPECT_EQ(status("a").state, NodeStatus::State::Quarantined);
    EXPECT_NE(status("a").quarantine.find("its scale is not that of the job"), std::string::npos);
    tick();
    EXPECT_TRUE(idle("a")) << "it is asked for nothing again";
}

TEST_F(CoordinatorTest, OneRefusalIsForgivenAfterAResult) {
    start({.iterations = 64});
    add("a");
    for (int i = 0; i < 6; ++i) {
        tick();
        const Lease lease = take("a");
        if (i % 3 == 2)
            EXPECT_EQ(deliver("a", lease.id, lease.range), Verdict::Committed);
        else
            coordinator_->reject(ids_["a"], lease.id, now_);
    }
    EXPECT_NE(status("a").state, NodeStatus::State::Quarantined);
}

// Rendered again it would not fit either: the job ends, by one sentence, and nothing more is leased.
TEST_F(CoordinatorTest, SumsThatDoNotFitEndTheJob) {
    const auto attempt = [&](const char* what, const char* sentence, auto&& change) {
        SCOPED_TRACE(what);
        start({.iterations = 64});
        ports_.clear();
        add("a");
        const Lease lease = largerLease("a");
        EXPECT_EQ(coordinator_->failure(), "");
        add("b"), add("c");
        tick();
        const Lease other = take("b"), half = take("c");
        BlockResult greatest = resultOf(job_, half.range);
        greatest.sums.values.back() = int64_t(1) << 62;
        EXPECT_EQ(coordinator_->deliver(ids_["c"], half.id, greatest, now_), Verdict::Committed);
        const FilmSums before = coordinator_->sums();
        BlockResult result = resultOf(job_, lease.range);
        change(result.sums);
        result.sha256 = result.sums.sha256();
        EXPECT_EQ(coordinator_->deliver(ids_["a"], lease.id, result, now_), Verdict::Rejected);
        EXPECT_NE(coordinator_->failure().find(sentence), std::string::npos) << coordinator_->failure();
        EXPECT_NE(coordinator_->failure().find("of node a"), std::string::npos) << coordinator_->failure();
        EXPECT_EQ(coordinator_->sums().sha256(), before.sha256()) << "what was committed stays";
        EXPECT_TRUE(port("b").isTruncated(other.id));
        for (int i = 0; i < 100; ++i) tick(10);
        EXPECT_TRUE(idle("a"));
        EXPECT_FALSE(coordinator_->complete());
    };
    attempt("merge", "pixel 1,0 of layer 'albedo' would overflow",
            [](FilmSums& sums) { sums.values.back() = int64_t(1) << 62; });
    attempt("device", "sums of pixels left 64 bits 3 times",
            [](FilmSums& sums) { sums.events.at(EventSource::Film, EventKind::SumOverflow) = 3; });
}

TEST_F(CoordinatorTest, LeasesOfOthersAreUnknown) {
    start({.iterations = 4});
    add("a");
    add("b");
    tick();
    const Lease a = take("a");
    EXPECT_EQ(deliver("b", a.id, a.range), Verdict::Rejected);
    EXPECT_FALSE(coordinator_->wanted(ids_["b"], a.id, a.range, std::string(64, '0'), now_));
    coordinator_->returned(ids_["b"], a.id, now_);
    coordinator_->reject(ids_["b"], a.id, now_);
    EXPECT_EQ(coordinator_->outstanding(), 2u);
    const IterationRange absurd{~uint64_t(0) - 1, ~uint64_t(0)};
    BlockResult result = resultOf(job_, a.range);
    result.range = absurd;
    EXPECT_EQ(coordinator_->deliver(ids_["a"], 999, result, now_), Verdict::Rejected);
    EXPECT_EQ(deliver("a", a.id, a.range), Verdict::Committed);
}

TEST_F(CoordinatorTest, ReturnedAndRejectedLeasesAreGivenOutAgain) {
    start({.iterations = 1});
    add("a");
    tick();
    coordinator_->returned(ids_["a"], take("a").id, now_);
    tick();
    const Lease again = take("a");
    EXPECT_TRUE(coordinator_->wanted(ids_["a"], again.id, again.range, std::string(64, '0'), now_));
    coordinator_->reject(ids_["a"], again.id, now_);
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_EQ(status("a").lost, 1u);
    tick();
    const Lease last = take("a");
    EXPECT_EQ(deliver("a", last.id, last.range), Verdict::Committed);
}

TEST_F(CoordinatorTest, WhoReturnsKeepsItsIdItsSpeedAndItsResults) {
    start({.iterations = 64});
    const NodeId id = add("a");
    const Lease lease = largerLease("a");
    coordinator_->removeNode(id, now_);
    EXPECT_EQ(status("a").state, NodeStatus::State::Gone);
    EXPECT_EQ(status("a").lost, lease.range.count);
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_EQ(add("a"), id);
    EXPECT_DOUBLE_EQ(status("a").iterationsPerSecond, 2);
    EXPECT_TRUE(coordinator_->wanted(id, lease.id, lease.range, std::string(64, '0'), now_));
    tick();
    EXPECT_FALSE(IterationSet({lease.range}).intersects(take("a").range)) << "which is on its way";
    EXPECT_EQ(deliver("a", lease.id, lease.range), Verdict::Committed);
    EXPECT_EQ(status("a").lost, 0u);
    expectExact();
}

TEST_F(CoordinatorTest, WhatALostNodeHeldGoesToOthers) {
    start({.iterations = 1});
    add("a");
    tick();
    const Lease lost = take("a");
    coordinator_->removeNode(ids_["a"], now_);
    add("b");
    tick();
    const Lease lease = take("b");
    EXPECT_EQ(lease.range, lost.range);
    EXPECT_EQ(deliver("b", lease.id, lease.range), Verdict::Committed);
    add("a");
    EXPECT_EQ(deliver("a", lost.id, lost.range), Verdict::NotNeeded);
    expectExact();
}

TEST_F(CoordinatorTest, ALatePartEndsTheLeaseOfWhoTookOver) {
    start({.iterations = 64, .leastPatienceSeconds = 10});
    add("a");
    const Lease late = largerLease("a");
    tick(11);
    add("b");
    tick();
    // The new node begins with one iteration of the block.
    const Lease other = take("b");
    EXPECT_TRUE(late.range.contains(other.range));
    EXPECT_EQ(deliver("a", late.id, {late.range.first, 1}), Verdict::Committed);
    EXPECT_TRUE(port("b").isTruncated(other.id));
    EXPECT_EQ(deliver("b", other.id, other.range), Verdict::NotNeeded);
    expectExact();
    for (tick(); !coordinator_->complete(); tick()) render("a", take("a"), 0.5);
    EXPECT_EQ(coordinator_->committed(), IterationSet({{0, 64}})) << "nothing is forgotten";
    expectExact();
}

TEST_F(CoordinatorTest, MixedClassesAreSaidOnce) {
    start({.iterations = 16});
    add("a", 1, "one");
    add("b", 1, "two");
    tick();
    render("a", take("a"), 1);
    EXPECT_EQ(messages(), "");
    render("b", take("b"), 1);
    EXPECT_NE(messages().find("only statistically"), std::string::npos);
    tick();
    render("b", take("b"), 1);
    EXPECT_EQ(messages(), "");
    EXPECT_EQ(coordinator_->checkpoint(0).deviceClasses, (std::vector<std::string>{"one", "two"}));
}

// ---- Ends

TEST_F(CoordinatorTest, FinishingEarlyKeepsAPrefix) {
    start({.iterations = {}});
    add("a");
    add("b");
    tick();
    const Lease a = take("a"), b = take("b");
    render("b", b, 1);
    coordinator_->finishEarly(now_);
    EXPECT_FALSE(coordinator_->complete());
    EXPECT_TRUE(port("a").isTruncated(a.id));
    tick();
    EXPECT_TRUE(idle("b")) << "nothing is begun beyond what is committed";
    coordinator_->returned(ids_["a"], a.id, now_);
    tick();
    EXPECT_EQ((port("a").granted.size() + port("b").granted.size()), 1u);
    const std::string who = idle("a") ? "b" : "a";
    const Lease gap = take(who);
    EXPECT_EQ(gap.range, a.range);
    EXPECT_EQ(deliver(who, gap.id, gap.range), Verdict::Committed);
    tick();
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(coordinator_->committed(), IterationSet({{0, 2}}));
    expectExact();
}

TEST_F(CoordinatorTest, WhatComesWhileFinishingIsKept) {
    start({.iterations = {}});
    add("a");
    Lease lease = largerLease("a");
    coordinator_->finishEarly(now_);
    tick();
    EXPECT_EQ(render("a", lease, 0.5, 1), Verdict::Committed);
    tick();
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(coordinator_->committed().end(), lease.range.first + 1);
}

TEST_F(CoordinatorTest, FinishingEarlyRendersOneIterationAtLeast) {
    start({.iterations = {}});
    coordinator_->finishEarly(now_);
    tick();
    EXPECT_FALSE(coordinator_->complete());
    add("a");
    tick();
    const Lease lease = take("a");
    EXPECT_EQ(lease.range, (IterationRange{0, 1}));
    deliver("a", lease.id, lease.range);
    EXPECT_TRUE(coordinator_->complete());
}

TEST_F(CoordinatorTest, ASilentNodeDoesNotHoldUpTheEnd) {
    start({.iterations = {}, .leastPatienceSeconds = 10});
    add("a");
    add("silent");
    tick();
    const Lease a = take("a"), silent = take("silent");
    ASSERT_LT(a.range.first, silent.range.first);
    deliver("a", a.id, a.range);
    coordinator_->finishEarly(now_);
    tick(19);
    EXPECT_FALSE(coordinator_->complete());
    tick(1);
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(deliver("silent", silent.id, silent.range), Verdict::NotNeeded) << "the end is fixed";
    EXPECT_EQ(coordinator_->committed().end(), 1u);
}

TEST_F(CoordinatorTest, ATimeLimitEndsACountedJob) {
    start({.iterations = 1000});
    add("a");
    const Lease lease = largerLease("a");
    coordinator_->finishEarly(now_);
    coordinator_->returned(ids_["a"], lease.id, now_);
    tick();
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(coordinator_->committed().count(), lease.range.first);
}

TEST_F(CoordinatorTest, StoppingKeepsWhatIsThere) {
    start({.iterations = 100});
    add("a", 2);
    tick();
    const Lease first = take("a"), second = take("a");
    coordinator_->stop(now_);
    EXPECT_TRUE(port("a").isTruncated(first.id) && port("a").isTruncated(second.id));
    EXPECT_EQ(deliver("a", first.id, first.range), Verdict::Committed);
    coordinator_->returned(ids_["a"], second.id, now_);
    tick();
    EXPECT_TRUE(idle("a"));
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_FALSE(coordinator_->complete());
    EXPECT_EQ(coordinator_->committed().count(), 1u);
}

TEST_F(CoordinatorTest, StoppingDoesNotWaitForTheSilent) {
    start({.iterations = 100});
    add("a");
    tick();
    coordinator_->stop(now_);
    tick(121);
    EXPECT_EQ(coordinator_->outstanding(), 0u);
}

// ---- Resuming

TEST_F(CoordinatorTest, AResumedJobEqualsAnUninterruptedOne) {
    start({.iterations = 50});
    add("a", 2);
    while (coordinator_->committed().count() < 20) {
        tick();
        render("a", take("a"), 0.3);
    }
    const Checkpoint checkpoint = decodeCheckpoint(encodeCheckpoint(coordinator_->checkpoint(12.5)));
    EXPECT_EQ(checkpoint.wallSeconds, 12.5);

    ports_.clear();
    start({.iterations = 50}, checkpoint);
    EXPECT_EQ(coordinator_->committed(), checkpoint.committed);
    add("b", 2);
    for (tick(); !coordinator_->complete(); tick()) {
        const Lease lease = take("b");
        EXPECT_FALSE(checkpoint.committed.intersects(lease.range));
        render("b", lease, 0.3);
    }
    EXPECT_EQ(coordinator_->sums().sha256(), fakeSums(job_.settings, {{0, 50}}).sha256());
    EXPECT_EQ(coordinator_->statistics().rays, 50u);
}

TEST_F(CoordinatorTest, RefusesToResumeSomethingElse) {
    Checkpoint checkpoint;
    checkpoint.job = job_;
    checkpoint.committed.add({0, 8});
    checkpoint.sums = fakeSums(job_.settings, {{0, 8}});
    expectError(ErrorCode::Usage, "8 iterations already", [&] { start({.iterations = 4}, checkpoint); });
    checkpoint.job.sceneHash = "other";
    expectError(ErrorCode::Usage, "another scene", [&] { start({.iterations = 100}, checkpoint); });
}
