// Blocks of iterations, rendered in the background: what a render server and the client's own device have in common.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "renderengine/error.h"
#include "renderengine/iteration_range.h"
#include "renderengine/renderer.h"

namespace antipode {

/// The sums of a block, or of the part of it, from its first iteration on, that was rendered before a truncation.
struct BlockResult {
    IterationRange range;
    FilmSums sums;                ///< sums.iterations == range.count
    std::string sha256;           ///< of `sums`
    EngineStatistics statistics;  ///< of these iterations
    double seconds = 0;           ///< wall time of rendering, without summing up
};

/// What is known of a job once it is ready to be rendered.
struct JobReady {
    double initialRadius = 0;  ///< scene units
    uint64_t lightPathsPerIteration = 0, deviceBytes = 0;
    uint64_t bvhPrimitives = 0;
    double bvhBuildSeconds = 0;
    double seconds = 0;  ///< wall time to build it
    /// Where the blocks are rendered elsewhere: what renderings of the job there can be equal to. Else empty: it
    /// follows from the device.
    std::string renderings = {};
    uint32_t width = 1;  ///< iterations that are rendered side by side
};

/// Blocks that a worker has in hand side by side: of all jobs together, and of one.
struct BlocksAtOnce {
    size_t all = 1, ofJob = 1;
};

/// Called from the worker's own thread (ThreadBlockWorker) or from whoever steps it (simulations). The callee must
/// return quickly.
struct BlockCallbacks {
    std::function<void(uint64_t iterationsDone)> progress;     ///< after each iteration of the block
    std::function<void(std::optional<BlockResult>)> finished;  ///< nothing where truncated before the first iteration
    std::function<void(const Error&)> failed;  ///< the job's renderer is gone; the job must be opened anew
};

/// One device and the renderers of the jobs that it serves, or what stands for one.
class BlockWorker {
public:
    using JobKey = std::string;  ///< chosen by the caller, unique among the jobs that are open

    virtual ~BlockWorker() = default;

    /// Builds the job's renderer, then calls one of the two. The scene is kept until the job is closed. `failed` may
    /// come after `ready`, too, where that is the end of this job and of no other; its blocks have ended then.
    virtual void openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                         std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) = 0;
    /// Renders a block of an open job after whatever was asked for before. Ends with `finished` or `failed`, once.
    virtual void renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) = 0;
    /// Ends the job's block that begins with iteration `first` after its current iteration; what is done of it is its
    /// result. A worker that has one block at a time ends the one in hand, whichever it is: from its first iteration
    /// until it is called back; where none is, the first that was asked for ends before its beginning.
    virtual void truncateBlock(const JobKey& job, uint64_t first) = 0;
    /// Frees the job's renderer after whatever was asked for before.
    virtual void closeJob(const JobKey& job) = 0;

    /// Blocks may be asked for before those before them have ended; those of one job that are in hand together have no
    /// iteration in common.
    virtual BlocksAtOnce blocksAtOnce() const { return {}; }
    /// Who is to be told, from now on, when more or fewer iterations of a job are rendered side by side than before.
    virtual void tellWidth(const std::function<void(const JobKey& job, uint32_t width)>&) {}
};

/// A thread that owns all renderers that `factory` makes.
class ThreadBlockWorker final : public BlockWorker {
public:
    explicit ThreadBlockWorker(RendererFactory factory);
    /// Truncates the block in hand, whose callback still comes, drops what was asked for after it without a callback,
    /// and joins the thread.
    ~ThreadBlockWorker() override;

    void openJob(const JobKey& job, std::shared_ptr<const Scene> scene, const RenderSettings& settings,
                 std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) override;
    void renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) override;
    void truncateBlock(const JobKey& job, uint64_t first) override;
    void closeJob(const JobKey& job) override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
