#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <new>
#include <stdexcept>
#include <thread>

#include "renderengine/block_worker.h"
#include "tests/blocks/block_log.h"
#include "tests/support/fake_renderer.h"

namespace antipode::test {
namespace {

RenderSettings small() {
    RenderSettings settings;
    settings.width = 3;
    settings.height = 2;
    return settings;
}

/// Settings that the fake's sums tell from small()'s.
RenderSettings wide() {
    RenderSettings settings = small();
    settings.width = 5;
    settings.initialRadius = 0.25;
    return settings;
}

std::shared_ptr<const Scene> scene() { return std::make_shared<const Scene>(tinyScene()); }

std::shared_ptr<FakeGate> gateAt(uint64_t iteration) { return std::make_shared<FakeGate>(iteration); }

class ThreadBlockWorkerTest : public testing::Test {
protected:
    ThreadBlockWorker& start(const FakeOptions& options = {}) { return start(fakeRenderers(options)); }
    ThreadBlockWorker& start(RendererFactory factory) { return worker_.emplace(std::move(factory)); }

    void open(const std::string& job, const RenderSettings& settings = small()) {
        worker_->openJob(job, scene(), settings, log_.ready(job), log_.failed(job));
    }
    void render(const std::string& job, IterationRange range) { worker_->renderBlock(job, range, log_.callbacks(job)); }
    void expectSums(const BlockEvent& event, const RenderSettings& settings, IterationRange range) {
        ASSERT_EQ(event.kind, BlockEvent::Finished) << event.message;
        ASSERT_TRUE(event.result);
        const FilmSums expected = fakeSums(settings, {range});
        EXPECT_EQ(event.result->range, range);
        EXPECT_EQ(event.result->sums.values, expected.values);
        EXPECT_EQ(event.result->sums.iterations, range.count);
        EXPECT_EQ(event.result->sha256, expected.sha256());
        EXPECT_EQ(event.result->statistics.rays, range.count * settings.width * settings.height);
        EXPECT_EQ(event.iterations, range.count) << "as the progress said";
    }

    BlockLog log_;
    std::optional<ThreadBlockWorker> worker_;  // first to go
};

TEST_F(ThreadBlockWorkerTest, EveryBlockHasItsOwnSumsAndTheyComeInOrder) {
    start();
    open("a", wide());
    const std::vector<IterationRange> blocks{{0, 4}, {8, 1}, {4, 4}, {uint64_t(1) << 40, 2}};
    for (const IterationRange& block : blocks) render("a", block);
    const BlockEvent ready = log_.next();
    ASSERT_EQ(ready.kind, BlockEvent::Ready);
    EXPECT_EQ(ready.ready.initialRadius, 0.25);
    EXPECT_EQ(ready.ready.lightPathsPerIteration, 10u);
    EXPECT_EQ(ready.ready.deviceBytes, 10u * 3 * 8);
    for (const IterationRange& block : blocks) expectSums(log_.next(), wide(), block);
}

TEST_F(ThreadBlockWorkerTest, KeepsSeveralJobsAtOnce) {
    start();
    open("a");
    open("b", wide());
    for (uint64_t i = 0; i < 3; ++i) {
        render("a", {i, 1});
        render("b", {i, 1});
    }
    EXPECT_EQ(log_.next().job, "a");
    EXPECT_EQ(log_.next().job, "b");
    for (uint64_t i = 0; i < 3; ++i) {
        expectSums(log_.next(), small(), {i, 1});
        expectSums(log_.next(), wide(), {i, 1});
    }
}

TEST_F(ThreadBlockWorkerTest, TruncatesAfterTheIterationInHand) {
    for (uint64_t point = 0; point < 4; ++point) {
        SCOPED_TRACE(point);
        const auto gate = gateAt(8 + point);
        start({.gate = gate});
        open("a");
        EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
        render("a", {8, 4});
        render("a", {16, 2});
        ASSERT_TRUE(gate->waitUntilReached());
        worker_->truncateBlock("a", 0);
        worker_->truncateBlock("a", 0);
        gate->release();
        expectSums(log_.next(), small(), {8, point + 1});
        expectSums(log_.next(), small(), {16, 2});
    }
}

TEST_F(ThreadBlockWorkerTest, TruncatedBeforeItsBeginningABlockHasNoResult) {
    std::promise<void> go;
    start([&](const Scene&, const RenderSettings& settings) {
        if (settings.width == wide().width) go.get_future().wait_for(std::chrono::seconds(10));
        return std::make_unique<FakeRenderer>(settings);
    });
    open("a");
    render("a", {0, 4});
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    expectSums(log_.next(), small(), {0, 4});
    open("b", wide());  // keeps the worker busy, without a block in hand
    render("a", {4, 4});
    render("a", {8, 4});
    worker_->truncateBlock("a", 0);
    worker_->truncateBlock("a", 0);
    go.set_value();
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    const BlockEvent first = log_.next();
    EXPECT_EQ(first.kind, BlockEvent::Finished);
    EXPECT_FALSE(first.result);
    EXPECT_EQ(first.iterations, 0u);
    expectSums(log_.next(), small(), {8, 4});
}

TEST_F(ThreadBlockWorkerTest, TruncatingNothingDoesNothing) {
    start().truncateBlock("a", 0);
    open("a");
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    worker_->truncateBlock("a", 0);
    render("a", {0, 2});
    expectSums(log_.next(), small(), {0, 2});
}

TEST_F(ThreadBlockWorkerTest, AFailureEndsItsJobAndNoOther) {
    start({.failAt = 5});
    open("a");
    open("b");
    log_.next(), log_.next();
    render("a", {4, 4});
    render("a", {0, 1});
    render("b", {0, 4});
    const BlockEvent failure = log_.next();
    EXPECT_EQ(failure.kind, BlockEvent::Failed);
    EXPECT_EQ(failure.code, ErrorCode::Device);
    EXPECT_EQ(failure.iterations, 1u);
    const BlockEvent after = log_.next();
    EXPECT_EQ(after.kind, BlockEvent::Failed);
    EXPECT_EQ(after.code, ErrorCode::Usage) << "the job has to be opened anew";
    expectSums(log_.next(), small(), {0, 4});
    open("a");
    render("a", {0, 1});
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    expectSums(log_.next(), small(), {0, 1});
}

/// Throws whatever it is told to, in its first iteration; counts itself.
class Thrower final : public Renderer {
public:
    Thrower(std::function<void()> fail, int& alive) : fail_(std::move(fail)), alive_(alive) { ++alive_; }
    ~Thrower() override { --alive_; }
    void render(uint64_t) override { fail_(); }
    FilmSums sums() const override { return {}; }
    void reset() override {}
    EngineStatistics statistics() const override { return {}; }

private:
    std::function<void()> fail_;
    int& alive_;
};

TEST_F(ThreadBlockWorkerTest, WhateverARendererThrowsIsADeviceErrorAndTheRendererIsGone) {
    struct Case {
        std::function<void()> fail;
        const char* message;
    };
    const Case cases[] = {{[] { throw std::bad_alloc(); }, "not enough memory"},
                          {[] { throw std::runtime_error("lost in space"); }, "lost in space"},
                          {[] { throw Error(ErrorCode::Input, "bad input"); }, "bad input"},
                          {[] { throw 7; }, "without saying why"}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.message);
        int alive = 0;
        start([&](const Scene&, const RenderSettings&) { return std::make_unique<Thrower>(c.fail, alive); });
        open("a");
        EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
        int aliveAtFailure = -1;
        BlockCallbacks callbacks = log_.callbacks("a");
        callbacks.failed = [&, tell = callbacks.failed](const Error& error) {
            aliveAtFailure = alive;
            tell(error);
        };
        worker_->renderBlock("a", {0, 1}, callbacks);
        const BlockEvent failure = log_.next();
        EXPECT_EQ(failure.kind, BlockEvent::Failed);
        EXPECT_EQ(failure.code, ErrorCode::Device);
        EXPECT_NE(failure.message.find(c.message), std::string::npos) << failure.message;
        EXPECT_EQ(aliveAtFailure, 0);
    }
}

TEST_F(ThreadBlockWorkerTest, AJobThatCannotBeBuiltIsNotOpen) {
    start([](const Scene&, const RenderSettings&) -> std::unique_ptr<Renderer> {
        throw Error(ErrorCode::Input, "no such triangle");
    });
    open("a");
    render("a", {0, 1});
    const BlockEvent failure = log_.next();
    EXPECT_EQ(failure.kind, BlockEvent::Failed);
    EXPECT_EQ(failure.code, ErrorCode::Input);
    EXPECT_EQ(failure.message, "no such triangle");
    EXPECT_EQ(log_.next().code, ErrorCode::Usage);
}

TEST_F(ThreadBlockWorkerTest, AJobIsOpenedOnce) {
    start();
    open("a");
    open("a", wide());
    render("a", {0, 1});
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    EXPECT_EQ(log_.next().code, ErrorCode::Usage);
    expectSums(log_.next(), small(), {0, 1});
}

TEST_F(ThreadBlockWorkerTest, ClosingFreesTheSceneOnceTheBlocksBeforeAreDone) {
    const auto gate = gateAt(0);
    start({.gate = gate});
    std::weak_ptr<const Scene> kept;
    {
        const auto mine = scene();
        kept = mine;
        worker_->openJob("a", mine, small(), log_.ready("a"), log_.failed("a"));
    }
    render("a", {0, 2});
    worker_->closeJob("a");
    render("a", {0, 1});
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    ASSERT_TRUE(gate->waitUntilReached());
    EXPECT_FALSE(kept.expired());
    gate->release();
    expectSums(log_.next(), small(), {0, 2});
    EXPECT_EQ(log_.next().code, ErrorCode::Usage);
    EXPECT_TRUE(kept.expired());
}

TEST_F(ThreadBlockWorkerTest, DestructionTruncatesTheBlockInHandAndDropsTheRest) {
    const auto gate = gateAt(1);
    start({.gate = gate});
    open("a");
    render("a", {0, 1000000000});
    render("a", {0, 1});
    open("b");
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    ASSERT_TRUE(gate->waitUntilReached());
    std::thread destroyer([this] { worker_.reset(); });
    gate->release();
    destroyer.join();
    const BlockEvent block = log_.next();
    ASSERT_EQ(block.kind, BlockEvent::Finished);
    ASSERT_TRUE(block.result);
    EXPECT_GE(block.result->range.count, 2u);
    EXPECT_LT(block.result->range.count, 1000000000u);
    EXPECT_TRUE(log_.empty());
}

/// Even before the callback of the block before it has returned: that one is over.
TEST_F(ThreadBlockWorkerTest, ATruncationAfterTheCallbackMeansTheNextBlock) {
    start();
    open("a");
    BlockCallbacks callbacks = log_.callbacks("a");
    callbacks.finished = [&, tell = callbacks.finished](std::optional<BlockResult> result) {
        render("a", {4, 4});
        worker_->truncateBlock("a", 0);
        tell(std::move(result));
    };
    worker_->renderBlock("a", {0, 4}, callbacks);
    EXPECT_EQ(log_.next().kind, BlockEvent::Ready);
    expectSums(log_.next(), small(), {0, 4});
    const BlockEvent next = log_.next();
    EXPECT_EQ(next.kind, BlockEvent::Finished);
    EXPECT_FALSE(next.result);
}

/// Truncations from another thread at any time: every block ends once, with a prefix of itself.
TEST_F(ThreadBlockWorkerTest, TruncationsMayComeAtAnyTime) {
    start();
    open("a");
    log_.next();
    std::atomic<bool> done = false;
    std::thread truncator([&] {
        while (!done) worker_->truncateBlock("a", 0);
    });
    for (uint64_t block = 0; block < 200; ++block) {
        render("a", {block * 8, 8});
        const BlockEvent event = log_.next();
        ASSERT_EQ(event.kind, BlockEvent::Finished);
        if (event.result) expectSums(event, small(), {block * 8, event.result->range.count});
    }
    done = true;
    truncator.join();
}

}  // namespace
}  // namespace antipode::test
