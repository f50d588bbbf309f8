#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <mutex>
#include <thread>

#include "farm/nodes/local_node.h"
#include "tests/support/fake_renderer.h"

namespace antipode::test {
namespace {

/// The coordinator's thread: runs what was posted when the test says so.
class Postbox {
public:
    void post(std::function<void()> action) {
        const std::lock_guard lock(mutex_);
        actions_.push_back(std::move(action));
    }
    size_t size() {
        const std::lock_guard lock(mutex_);
        return actions_.size();
    }
    /// Runs the oldest action; false where there is none.
    bool runOne() {
        std::function<void()> action;
        {
            const std::lock_guard lock(mutex_);
            if (actions_.empty()) return false;
            action = std::move(actions_.front());
            actions_.pop_front();
        }
        action();
        return true;
    }
    void runAll() {
        while (runOne()) {
        }
    }

private:
    std::mutex mutex_;
    std::deque<std::function<void()>> actions_;
};

/// Does nothing by itself: the test answers for it.
class ManualWorker final : public BlockWorker {
public:
    struct Block {
        IterationRange range;
        BlockCallbacks callbacks;
    };

    void openJob(const JobKey&, std::shared_ptr<const Scene>, const RenderSettings& settings,
                 std::function<void(const JobReady&)> whenReady,
                 std::function<void(const Error&)> whenFailed) override {
        renderer_.emplace(settings);
        ready = std::move(whenReady);
        failed = std::move(whenFailed);
    }
    void renderBlock(const JobKey&, IterationRange range, BlockCallbacks callbacks) override {
        blocks.push_back({range, std::move(callbacks)});
    }
    void truncateBlock(const JobKey&, uint64_t) override { ++truncations; }
    void closeJob(const JobKey&) override { ++closings; }

    /// Renders the oldest block's first `count` iterations and ends it.
    void finish(uint64_t count) {
        const Block block = std::move(blocks.front());
        blocks.pop_front();
        if (count == 0) return block.callbacks.finished({});
        renderer_->reset();
        for (uint64_t i = 0; i < count; ++i) {
            renderer_->render(block.range.first + i + 1);
            block.callbacks.progress(i + 1);
        }
        BlockResult result{{block.range.first, count}, renderer_->sums(), {}, renderer_->statistics(), 1.0};
        result.sha256 = result.sums.sha256();
        block.callbacks.finished(std::move(result));
    }
    void finishWhole() { finish(blocks.front().range.count); }

    std::function<void(const JobReady&)> ready;
    std::function<void(const Error&)> failed;
    std::deque<Block> blocks;
    int truncations = 0, closings = 0;

private:
    std::optional<FakeRenderer> renderer_;
};

RenderSettings small() {
    RenderSettings settings;
    settings.width = 4;
    settings.height = 2;
    settings.initialRadius = 0.5;
    return settings;
}

class LocalNodeTest : public testing::Test {
protected:
    void start(BlockWorker& worker, uint64_t iterations) {
        const auto scene = std::make_shared<const Scene>(tinyScene());
        CoordinatorOptions options;
        options.iterations = iterations;
        coordinator_.emplace(resolveJob(*scene, small(), {small().width, small().height}), options);
        node_.emplace(LocalNodeContext{*coordinator_, worker,
                                       [this](std::function<void()> action) { box_.post(std::move(action)); },
                                       [this] { return now_; },
                                       [this](const Error& error) {
                                           failure_ = error;
                                           node_.reset();
                                       }},
                      "Fake", "fake class", scene, small());
    }

    /// A node with two leases, of a job that goes on behind them.
    void startWithTwoLeases(uint64_t iterations = 1000) {
        start(manual_, iterations);
        manual_.ready({.initialRadius = 0.5, .lightPathsPerIteration = 8, .deviceBytes = 100, .seconds = 0.25});
        box_.runAll();
        ASSERT_EQ(coordinator_->outstanding(), 2u);
        ASSERT_EQ(manual_.blocks.size(), 1u);
    }

    Postbox box_;
    ManualWorker manual_;
    double now_ = 100;
    std::optional<Coordinator> coordinator_;
    std::optional<LocalNode> node_;
    std::optional<Error> failure_;
};

TEST_F(LocalNodeTest, RendersAWholeJobOnAThread) {
    ThreadBlockWorker worker(fakeRenderers());
    start(worker, 500);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!coordinator_->complete() && std::chrono::steady_clock::now() < deadline) {
        if (!box_.runOne()) std::this_thread::yield();
        now_ += 1e-3;
        coordinator_->tick(now_);
    }
    EXPECT_TRUE(coordinator_->complete());
    EXPECT_EQ(coordinator_->sums().sha256(), fakeSums(small(), {{0, 500}}).sha256());
    EXPECT_EQ(coordinator_->nodes().at(0).committed, 500u);
    node_.reset();  // before the worker
}

TEST_F(LocalNodeTest, JoinsWhenItsJobIsReady) {
    start(manual_, 1000);
    coordinator_->tick(now_);
    EXPECT_TRUE(coordinator_->nodes().empty());
    EXPECT_FALSE(node_->ready());
    manual_.ready({.initialRadius = 0.5, .lightPathsPerIteration = 8, .deviceBytes = 100, .seconds = 0.25});
    EXPECT_TRUE(coordinator_->nodes().empty()) << "not on the worker's thread";
    box_.runAll();
    ASSERT_EQ(coordinator_->nodes().size(), 1u);
    const NodeDescription description = coordinator_->nodes().front().description;
    EXPECT_EQ(description.name, "local");
    EXPECT_EQ(description.deviceName, "Fake");
    EXPECT_EQ(description.deviceClass, "fake class");
    ASSERT_TRUE(node_->ready());
    EXPECT_EQ(node_->ready()->deviceBytes, 100u);
}

TEST_F(LocalNodeTest, FewerLightPathsAreAnotherClass) {
    start(manual_, 10);
    manual_.ready({.initialRadius = 0.5, .lightPathsPerIteration = 7, .deviceBytes = 100, .seconds = 0.25});
    box_.runAll();
    ASSERT_EQ(coordinator_->nodes().size(), 1u);
    EXPECT_EQ(coordinator_->nodes().front().description.deviceClass, "fake class with 7 light paths");
}

TEST_F(LocalNodeTest, TheNextBlockBeginsBeforeTheResultIsMerged) {
    startWithTwoLeases();
    const IterationRange first = manual_.blocks.front().range;
    manual_.finishWhole();
    EXPECT_TRUE(coordinator_->committed().empty());
    box_.runAll();
    EXPECT_EQ(coordinator_->committed().ranges(), std::vector{first});
    EXPECT_EQ(coordinator_->outstanding(), 2u) << "and another lease is granted";
    ASSERT_EQ(manual_.blocks.size(), 1u) << "one at a time";
    EXPECT_EQ(manual_.blocks.front().range.first, first.end());
}

TEST_F(LocalNodeTest, ProgressIsPostedOnceHoweverFastItComes) {
    startWithTwoLeases();
    const auto progress = manual_.blocks.front().callbacks.progress;
    for (uint64_t done = 1; done <= 100; ++done) progress(done);
    EXPECT_EQ(box_.size(), 1u);
    box_.runAll();
    progress(101);
    EXPECT_EQ(box_.size(), 1u);
    box_.runAll();
}

TEST_F(LocalNodeTest, TruncationDeliversWhatIsDoneAndReturnsWhatWaits) {
    startWithTwoLeases();
    manual_.finishWhole();
    box_.runAll();
    const uint64_t before = coordinator_->committed().count();
    // A block of some size, so that it can be cut.
    while (manual_.blocks.front().range.count < 2) {
        now_ += 1e-3;
        manual_.finishWhole();
        box_.runAll();
        ASSERT_FALSE(coordinator_->complete());
    }
    const uint64_t first = manual_.blocks.front().range.first;
    coordinator_->stop(now_);
    EXPECT_EQ(manual_.truncations, 1);
    EXPECT_EQ(coordinator_->outstanding(), 2u) << "nothing is called back from within a call";
    box_.runAll();
    EXPECT_EQ(coordinator_->outstanding(), 1u);
    manual_.finish(1);
    box_.runAll();
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_TRUE(manual_.blocks.empty());
    EXPECT_GT(coordinator_->committed().count(), before);
    EXPECT_EQ(coordinator_->committed().ranges(), (std::vector<IterationRange>{{0, first + 1}}));
    EXPECT_EQ(coordinator_->sums().sha256(), fakeSums(small(), {{0, first + 1}}).sha256());
}

TEST_F(LocalNodeTest, ABlockTruncatedBeforeItsBeginningIsReturned) {
    startWithTwoLeases();
    coordinator_->stop(now_);
    manual_.finish(0);
    box_.runAll();
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_TRUE(coordinator_->committed().empty());
}

TEST_F(LocalNodeTest, AFailureRemovesTheNodeAndIsTold) {
    startWithTwoLeases();
    manual_.blocks.front().callbacks.failed(Error(ErrorCode::Device, "the device is lost"));
    EXPECT_FALSE(failure_);
    box_.runAll();
    ASSERT_TRUE(failure_);
    EXPECT_STREQ(failure_->what(), "the device is lost");
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_EQ(coordinator_->nodes().at(0).state, NodeStatus::State::Gone);
}

TEST_F(LocalNodeTest, AJobThatCannotBeBuiltNeverJoins) {
    start(manual_, 10);
    manual_.failed(Error(ErrorCode::Device, "no memory"));
    box_.runAll();
    ASSERT_TRUE(failure_);
    EXPECT_STREQ(failure_->what(), "no memory");
    EXPECT_TRUE(coordinator_->nodes().empty());
}

TEST_F(LocalNodeTest, DestroyedWithWorkInHandItLeavesAndHearsNothingMore) {
    startWithTwoLeases();
    const auto late = manual_.blocks.front().callbacks;
    late.progress(1);
    node_.reset();
    EXPECT_EQ(coordinator_->outstanding(), 0u);
    EXPECT_EQ(coordinator_->nodes().at(0).state, NodeStatus::State::Gone);
    EXPECT_EQ(manual_.truncations, 1);
    EXPECT_EQ(manual_.closings, 1);
    late.progress(2);
    manual_.finish(1);
    late.failed(Error(ErrorCode::Device, "too late"));
    manual_.ready({});
    box_.runAll();
    EXPECT_TRUE(coordinator_->committed().empty());
    EXPECT_FALSE(failure_);
}

}  // namespace
}  // namespace antipode::test
