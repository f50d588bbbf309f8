// A worker that tests step, and the thread that its queue believes to run on.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "renderengine/block_worker.h"

namespace antipode::test {

/// Calls that were posted, in order.
class CallLoop {
public:
    std::function<void(std::function<void()>)> post() {
        return [this](std::function<void()> call) { calls_.push_back(std::move(call)); };
    }
    void run();

private:
    std::deque<std::function<void()>> calls_;
};

/// Jobs are told apart by their seeds. Fails the test when it holds two blocks, or a block of a job that is not open.
class SteppedWorker final : public BlockWorker {
public:
    explicit SteppedWorker(RendererFactory factory) : factory_(std::move(factory)) {}

    void openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                 std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) override;
    void renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) override;
    void truncateBlock(const JobKey& job, uint64_t first) override;
    void closeJob(const JobKey& job) override;

    /// Builds or closes a job, or renders one iteration, or ends a block. False where there is nothing to do.
    bool step();

    std::optional<Error> failNext{};                            ///< what the next build or iteration throws
    std::map<uint64_t, double> secondsPerIteration{};           ///< by seed; 1 without
    std::vector<std::pair<uint64_t, IterationRange>> blocks{};  ///< that were finished: seed and iterations
    double secondsOf(uint64_t seed) const;                      ///< that the job's blocks have taken
    size_t openJobs() const { return jobs_.size(); }
    size_t pending() const { return commands_.size(); }

private:
    struct Open {
        JobKey job;
        std::shared_ptr<const Scene> scene;
        RenderSettings settings;
        std::function<void(const JobReady&)> ready;
        std::function<void(const Error&)> failed;
    };
    struct Block {
        JobKey job;
        IterationRange range;
        BlockCallbacks callbacks;
        uint64_t done = 0;
        bool truncated = false;
    };
    struct Close {
        JobKey job;
    };
    struct Job {
        uint64_t seed;
        std::unique_ptr<Renderer> renderer;
    };

    bool execute(Open& open);
    bool execute(Block& block);
    bool execute(Close& close);
    Block* blockInHand();
    double secondsFor(uint64_t seed) const;

    RendererFactory factory_;
    std::map<JobKey, Job> jobs_;
    std::deque<std::variant<Open, Block, Close>> commands_;
};

}  // namespace antipode::test
