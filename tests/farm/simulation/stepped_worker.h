// A device in virtual time, whose renderers count.
#pragma once

#include <deque>
#include <map>
#include <memory>

#include "renderengine/block_worker.h"
#include "tests/farm/simulation/event_loop.h"
#include "tests/support/fake_renderer.h"

namespace antipode::simulation {

struct DeviceModel {
    double secondsPerIteration = 0.1;
    double buildSeconds = 0.5;
    bool lies = false;   ///< wrong sums, and the hash that belongs to them
    bool noise = false;  ///< sums that cannot be compressed
    bool bombs = false;  ///< sums that leave no room for others
    bool otherScale = false;
};

class SteppedWorker final : public BlockWorker {
public:
    SteppedWorker(Process& process, DeviceModel model) : process_(process), model_(model) {}

    void openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                 std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) override;
    void renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) override;
    void truncateBlock(const JobKey& job, uint64_t first) override;
    void closeJob(const JobKey& job) override;

    /// What the device does from now on takes until then at least; the process knows nothing of it.
    void hang(double until) { hangsUntil_ = until; }
    /// The renderer of the block in hand fails at its next iteration.
    void failNext() { failNext_ = true; }
    uint64_t iterations() const { return iterations_; }

private:
    struct Block {
        JobKey job;
        IterationRange range;
        BlockCallbacks callbacks;
        uint64_t done = 0;
        double start = 0;
        bool truncated = false;
    };

    /// Runs the action after what was asked for before; it takes so long.
    void enqueue(std::function<void()> task);
    void next();
    void step(const std::shared_ptr<Block>& block);
    void finish(Block& block);
    void afterDevice(double seconds, const std::function<void()>& action);

    Process& process_;
    const DeviceModel model_;
    std::map<JobKey, std::unique_ptr<test::FakeRenderer>> renderers_;
    std::deque<std::function<void()>> tasks_;
    std::deque<std::shared_ptr<Block>> blocks_;  ///< in hand or queued
    bool busy_ = false, failNext_ = false;
    double hangsUntil_ = 0;
    uint64_t iterations_ = 0;
};

}  // namespace antipode::simulation
