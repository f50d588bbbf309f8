// A render from its first lease to its last.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "client/interrupt.h"
#include "farm/nodes/farm.h"
#include "client/progress.h"
#include "client/render_options.h"
#include "client/stop_reason.h"
#include "renderengine/error_estimate.h"
#include "renderengine/renderer.h"

namespace antipode {

/// What a checkpoint brought along.
struct EarlierRuns {
    uint64_t iterations = 0, rays = 0;
    double seconds = 0;  ///< of rendering
};

/// A finished render and everything that its reports tell.
struct RenderResult {
    std::string scenePath, sceneHash, jobHash;
    RenderSettings settings;
    std::vector<PathClass> missing;  ///< from the image, see JobDefinition
    std::optional<TechniqueChoice> choice;
    FilmSums sums;
    EngineStatistics statistics;
    std::vector<NodeReport> nodes;
    std::string device;                      ///< all that contributed, joined
    double wallSeconds = 0, cpuSeconds = 0;  ///< of the iterations, without loading and building; CPU: this process
    double setupSeconds = 0;                 ///< wall time until the first node was ready
    double finalRadius = 0;                  ///< merge radius of the last iteration, scene units
    EarlierRuns earlier;                     ///< included in sums and statistics, not in the times above
    bool interrupted = false;                ///< ended before all iterations were rendered
    StopReason stoppedBy = StopReason::Iterations;
    std::optional<ErrorEstimate> error;  ///< of the image; where it was to be estimated, and can be
    std::string failure;                 ///< why it could not go on; empty where it could

    /// All rays traced, shadow rays too.
    uint64_t totalRays() const { return statistics.rays + statistics.shadowRays; }
    double raysPerSecond() const { return wallSeconds > 0 ? double(totalRays() - earlier.rays) / wallSeconds : 0; }
    double iterationsPerSecond() const {
        return wallSeconds > 0 ? double(sums.iterations - earlier.iterations) / wallSeconds : 0;
    }
};

class LiveView;

/// The job that the options ask for; a checkpoint's choice of technique is kept. Throws Error.
JobDefinition resolveRender(const RenderOptions& options, const Scene& scene, Progress& progress);

/// Renders the job until the limits of `options`, a signal or the page, on this machine's device or on a farm; goes on
/// from the checkpoint where there is one. `view` may be null. Throws Error.
RenderResult runRender(const RenderOptions& options, JobDefinition job, std::shared_ptr<const Scene> scene,
                       SignalGuard& signals, Progress& progress, LiveView* view = nullptr);

}  // namespace antipode
