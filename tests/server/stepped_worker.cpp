#include "tests/server/stepped_worker.h"

#include <gtest/gtest.h>

namespace antipode::test {

void CallLoop::run() {
    while (!calls_.empty()) {
        const auto call = std::move(calls_.front());
        calls_.pop_front();
        call();
    }
}

void SteppedWorker::openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                            std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) {
    EXPECT_TRUE(scene);
    commands_.push_back(Open{job, std::move(scene), settings, std::move(ready), std::move(failed)});
}

void SteppedWorker::renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) {
    EXPECT_EQ(blockInHand(), nullptr) << "a second block";
    commands_.push_back(Block{job, range, std::move(callbacks)});
}

void SteppedWorker::truncateBlock(const JobKey&, uint64_t) {
    Block* block = blockInHand();
    if (block) block->truncated = true;
}

void SteppedWorker::closeJob(const JobKey& job) { commands_.push_back(Close{job}); }

bool SteppedWorker::step() {
    if (commands_.empty()) return false;
    // What a command's callbacks ask for comes behind it.
    auto& command = commands_.front();
    const bool over = std::visit([this](auto& c) { return execute(c); }, command);
    if (over) commands_.pop_front();
    return true;
}

bool SteppedWorker::execute(Open& open) {
    if (failNext) {
        open.failed(*std::exchange(failNext, std::nullopt));
        return true;
    }
    EXPECT_FALSE(jobs_.contains(open.job));
    jobs_[open.job] = {open.settings.seed, factory_(*open.scene, open.settings)};
    open.ready({.initialRadius = *open.settings.initialRadius,
                .lightPathsPerIteration = 7,
                .deviceBytes = 1000,
                .seconds = 0.5});
    return true;
}

bool SteppedWorker::execute(Block& block) {
    const auto job = jobs_.find(block.job);
    if (job == jobs_.end()) {
        ADD_FAILURE() << "a block of a job that is not open";
        return true;
    }
    if (failNext) {
        jobs_.erase(job);
        block.callbacks.failed(*std::exchange(failNext, std::nullopt));
        return true;
    }
    Renderer& renderer = *job->second.renderer;
    const uint64_t seed = job->second.seed;
    if (!block.truncated) {
        if (block.done == 0) renderer.reset();
        renderer.render(block.range.first + ++block.done);
        block.callbacks.progress(block.done);
        if (block.done < block.range.count) return false;
    }
    if (block.done == 0) {
        block.callbacks.finished({});
        return true;
    }
    BlockResult result;
    result.range = {block.range.first, block.done};
    result.sums = renderer.sums();
    result.sha256 = result.sums.sha256();
    result.statistics = renderer.statistics();
    result.seconds = double(block.done) * secondsFor(seed);
    blocks.emplace_back(seed, result.range);
    block.callbacks.finished(std::move(result));
    return true;
}

bool SteppedWorker::execute(Close& close) {
    jobs_.erase(close.job);
    return true;
}

SteppedWorker::Block* SteppedWorker::blockInHand() {
    for (auto& command : commands_)
        if (auto* block = std::get_if<Block>(&command)) return block;
    return nullptr;
}

double SteppedWorker::secondsFor(uint64_t seed) const {
    const auto seconds = secondsPerIteration.find(seed);
    return seconds == secondsPerIteration.end() ? 1 : seconds->second;
}

double SteppedWorker::secondsOf(uint64_t seed) const {
    double seconds = 0;
    for (const auto& [of, range] : blocks)
        if (of == seed) seconds += double(range.count) * secondsFor(seed);
    return seconds;
}

}  // namespace antipode::test
