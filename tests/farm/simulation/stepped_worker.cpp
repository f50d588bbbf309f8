#include "tests/farm/simulation/stepped_worker.h"

#include <algorithm>
#include <utility>

namespace antipode::simulation {

void SteppedWorker::enqueue(std::function<void()> task) {
    tasks_.push_back(std::move(task));
    if (!busy_) next();
}

void SteppedWorker::next() {
    busy_ = !tasks_.empty();
    if (!busy_) return;
    process_.after(0, [this] {
        const auto task = std::move(tasks_.front());
        tasks_.pop_front();
        task();
    });
}

void SteppedWorker::afterDevice(double seconds, const std::function<void()>& action) {
    process_.after(seconds, [this, action] {
        if (hangsUntil_ > process_.now())
            afterDevice(hangsUntil_ - process_.now(), action);
        else
            action();
    });
}

void SteppedWorker::openJob(const JobKey& job, std::shared_ptr<const Scene>, const RenderSettings& settings,
                            std::function<void(const JobReady&)> ready, std::function<void(const Error&)>) {
    enqueue([this, job, settings, ready = std::move(ready)] {
        afterDevice(model_.buildSeconds, [this, job, settings, ready] {
            test::FakeOptions options;
            options.lie = model_.lies;
            options.noise = model_.noise;
            options.bomb = model_.bombs;
            if (model_.otherScale) {
                options.film = test::fakeSums(settings, {}).layout;
                ++options.film->layers.front().scaleExponent;
            }
            auto renderer = std::make_unique<test::FakeRenderer>(settings, options);
            const EngineStatistics statistics = renderer->statistics();
            renderers_[job] = std::move(renderer);
            JobReady built;
            built.initialRadius = statistics.initialRadius;
            built.lightPathsPerIteration = statistics.lightPathsPerIteration;
            built.deviceBytes = statistics.deviceBytes;
            built.seconds = model_.buildSeconds;
            ready(built);
            next();
        });
    });
}

void SteppedWorker::renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) {
    auto block = std::make_shared<Block>(Block{job, range, std::move(callbacks)});
    blocks_.push_back(block);
    enqueue([this, block] {
        block->start = process_.now();
        step(block);
    });
}

void SteppedWorker::step(const std::shared_ptr<Block>& block) {
    if (block->truncated) {
        finish(*block);
        return;
    }
    afterDevice(model_.secondsPerIteration, [this, block] {
        if (std::exchange(failNext_, false)) {
            renderers_.erase(block->job);
            blocks_.pop_front();
            block->callbacks.failed(Error(ErrorCode::Device, "The simulated device was lost."));
            return next();
        }
        const auto renderer = renderers_.find(block->job);
        if (renderer == renderers_.end()) throw std::logic_error("a block came for a job that is not open");
        renderer->second->render(block->range.first + block->done + 1);
        ++iterations_;
        ++block->done;
        block->callbacks.progress(block->done);
        if (block->done == block->range.count)
            finish(*block);
        else
            step(block);
    });
}

void SteppedWorker::finish(Block& block) {
    std::optional<BlockResult> result;
    if (block.done > 0) {
        test::FakeRenderer& renderer = *renderers_.at(block.job);
        FilmSums sums = renderer.sums();
        std::string sha256 = sums.sha256();
        result = BlockResult{{block.range.first, block.done},
                             std::move(sums),
                             std::move(sha256),
                             renderer.statistics(),
                             process_.now() - block.start};
        renderer.reset();
    }
    blocks_.pop_front();
    block.callbacks.finished(std::move(result));
    next();
}

void SteppedWorker::truncateBlock(const JobKey&, uint64_t) {
    if (!blocks_.empty()) blocks_.front()->truncated = true;
}

void SteppedWorker::closeJob(const JobKey& job) {
    enqueue([this, job] {
        renderers_.erase(job);
        next();
    });
}

}  // namespace antipode::simulation
