// Blocks that are asked for one by one, and nodes that render several iterations side by side.
#include "farm/jobs/parts.h"
#include "tests/film/expect_error.h"
#include "tests/jobs/job_fixture.h"

using namespace antipode;
using namespace antipode::test;

namespace {

class PartsTest : public JobTest {
protected:
    void startParts(double verifyFraction = 0) {
        start({.iterations = {}, .inParts = true, .verifyFraction = verifyFraction});
    }
    /// Renders all leases that the node has and gets.
    void renderAll(const std::string& name, bool lie = false) {
        for (tick(); !idle(name); tick()) render(name, take(name), 0.5, {}, lie);
    }
    /// Takes the only block that is finished and expects it to be of these iterations.
    void expectBlock(uint64_t first, const IterationRange& range) {
        ASSERT_EQ(coordinator_->finishedParts(), std::vector{first});
        const std::optional<BlockResult> result = coordinator_->takePart(first, now_);
        ASSERT_EQ(result.has_value(), range.count > 0);
        if (!result) return;
        EXPECT_EQ(result->range, range);
        EXPECT_EQ(result->sums.sha256(), fakeSums(job_.settings, {range}).sha256());
        EXPECT_EQ(result->sums.events, eventsOf(range.count));
        EXPECT_EQ(result->statistics.rays, range.count);
        EXPECT_TRUE(coordinator_->finishedParts().empty());
    }
};

}  // namespace

TEST_F(PartsTest, NothingIsRenderedThatNobodyAsksFor) {
    startParts();
    add("a");
    tick(10);
    EXPECT_TRUE(idle("a"));
    EXPECT_TRUE(coordinator_->finishedParts().empty());
}

TEST_F(PartsTest, EachBlockComesWithItsOwnSums) {
    startParts();
    add("a"), add("b");
    coordinator_->ask({64, 16});
    coordinator_->ask({0, 8});
    coordinator_->ask({80, 16});  // next to the first
    for (int i = 0; i < 40 && coordinator_->finishedParts().size() < 3; ++i)
        for (const char* name : {"a", "b"}) {
            tick();
            if (!idle(name)) render(name, take(name), 0.5);
        }
    ASSERT_EQ(coordinator_->finishedParts(), (std::vector<uint64_t>{0, 64, 80}));
    for (const IterationRange& block : {IterationRange{0, 8}, IterationRange{64, 16}, IterationRange{80, 16}}) {
        const auto result = coordinator_->takePart(block.first, now_);
        ASSERT_TRUE(result);
        EXPECT_EQ(result->range, block);
        EXPECT_EQ(result->sums.sha256(), fakeSums(job_.settings, {block}).sha256());
    }
    coordinator_->ask({64, 16});  // once more
    renderAll("a");
    expectBlock(64, {64, 16});
}

TEST_F(PartsTest, LeasesLieWithinOneBlock) {
    startParts();
    add("a");
    coordinator_->ask({0, 256});
    renderAll("a");
    expectBlock(0, {0, 256});
    for (uint64_t first = 256; first < 512; first += 4) coordinator_->ask({first, 4});
    for (tick(); !idle("a"); tick()) {
        const Lease lease = take("a");
        EXPECT_EQ(lease.range.first / 4, (lease.range.end() - 1) / 4);
        render("a", lease, 0.01);
    }
    EXPECT_EQ(coordinator_->finishedParts().size(), 64u);
}

TEST_F(PartsTest, ABlockThatIsCutIsAPrefix) {
    startParts();
    add("a"), add("b");
    coordinator_->ask({0, 64});
    tick();
    const Lease first = take("a"), second = take("b");
    EXPECT_EQ(render("b", second, 0.5), Verdict::Committed);
    coordinator_->cut(0, now_);
    tick();
    EXPECT_TRUE(idle("b")) << "something was begun";
    EXPECT_TRUE(coordinator_->finishedParts().empty()) << "the first lease is in hand";
    EXPECT_EQ(render("a", first, 0.5), Verdict::Committed);
    expectBlock(0, {0, second.range.end()});
}

TEST_F(PartsTest, WhatIsMissingBelowIsRenderedBeforeACutBlockEnds) {
    startParts();
    add("a"), add("b");
    coordinator_->ask({0, 64});
    tick();
    take("a");
    const Lease second = take("b");
    EXPECT_EQ(render("b", second, 0.5), Verdict::Committed);
    coordinator_->cut(0, now_);
    coordinator_->removeNode(ids_["a"], now_);
    renderAll("b");
    expectBlock(0, {0, second.range.end()});
}

TEST_F(PartsTest, ABlockThatIsCutBeforeItBeginsComesToNothing) {
    startParts();
    coordinator_->ask({32, 32});
    coordinator_->cut(32, now_);
    expectBlock(32, {32, 0});
    add("a");
    tick(1);
    EXPECT_TRUE(idle("a"));
}

TEST_F(PartsTest, WhatIsRenderedIsCountedBeforeItIsCommitted) {
    startParts();
    add("a");
    coordinator_->ask({0, 16});
    renderAll("a");
    expectBlock(0, {0, 16});
    coordinator_->ask({16, 16});
    tick();
    const Lease lease = take("a");
    coordinator_->progress(ids_["a"], lease.id, 1, now_ += 0.5);
    EXPECT_EQ(coordinator_->rendered(16), 1u);
    EXPECT_EQ(render("a", lease, 0.5), Verdict::Committed);
    EXPECT_EQ(coordinator_->rendered(16), lease.range.count);
}

TEST_F(PartsTest, ALiarIsFoundBeforeABlockIsFinished) {
    startParts(1);
    add("liar"), add("b"), add("c");
    coordinator_->ask({0, 8});
    for (int i = 0; i < 200 && coordinator_->finishedParts().empty(); ++i)
        for (const char* name : {"liar", "b", "c"}) {
            tick();
            if (!idle(name)) render(name, take(name), 0.5, {}, std::string(name) == "liar");
        }
    EXPECT_EQ(status("liar").state, NodeStatus::State::Quarantined);
    expectBlock(0, {0, 8});
}

TEST_F(PartsTest, NodesOfAnotherClassAreNotUsed) {
    startParts();
    add("a"), add("b", 1, "other");
    coordinator_->ask({0, 64});
    tick();
    EXPECT_FALSE(idle("a"));
    EXPECT_TRUE(idle("b"));
    EXPECT_EQ(coordinator_->width(), 1u);
    EXPECT_EQ(coordinator_->renderingClass(), "class");
    EXPECT_NE(messages().find("give it another relay"), std::string::npos);
}

// ---- Nodes that render side by side

TEST_F(PartsTest, AWideNodeGetsAtLeastOneIterationForEachOfItsOwn) {
    start({.iterations = 64});
    const NodeId wide = coordinator_->addNode({"wide", "device", "class", 2, 12}, ports_["wide"], now_);
    ids_["wide"] = wide;
    tick();
    Lease lease = take("wide");
    EXPECT_EQ(lease.range, (IterationRange{0, 8}));
    for (;; lease = take("wide")) {
        EXPECT_GE(lease.range.count, 8u);
        render("wide", lease, 0.1);
        tick();
        if (idle("wide")) break;
    }
    EXPECT_TRUE(coordinator_->complete());
}

TEST_F(PartsTest, AWideNodesSpeedIsThatOfAllItsLeasesTogether) {
    start({.iterations = 100000});
    const NodeId wide = coordinator_->addNode({"wide", "device", "class", 2, 16}, ports_["wide"], now_);
    tick();
    const Lease a = take("wide"), b = take("wide");
    for (uint64_t done = 1; done <= 10; ++done) {  // side by side, twenty iterations a second
        coordinator_->progress(wide, a.id, done, now_ += 0.05);
        coordinator_->progress(wide, b.id, done, now_ += 0.05);
    }
    EXPECT_NEAR(coordinator_->nodes().front().iterationsPerSecond, 20, 0.5);
}

TEST_F(PartsTest, AWideNodeIsGivenTheTimeThatOneIterationTakesItsOwn) {
    start({.iterations = 1000});
    const NodeId wide = coordinator_->addNode({"wide", "device", "class", 1, 64}, ports_["wide"], now_);
    ids_["wide"] = wide;
    tick();
    const Lease lease = take("wide");
    coordinator_->progress(wide, lease.id, 60, now_ += 100);  // 64 of them, a hundred seconds each
    tick(99);
    EXPECT_EQ(status("wide").state, NodeStatus::State::Rendering);
    EXPECT_EQ(status("wide").lost, 0u);
}

TEST_F(PartsTest, ANodeOfNoWidthGetsNothing) {
    start({.iterations = 64});
    add("a");
    coordinator_->setWidth(ids_["a"], 0, now_);
    tick();
    EXPECT_TRUE(idle("a"));
    coordinator_->setWidth(ids_["a"], 4, now_);
    tick();
    EXPECT_EQ(take("a").range.count, 4u);
}
