// The iteration loop.
#pragma once

#include <string>

#include "client/render_options.h"
#include "renderengine/engine.h"

namespace antipode {

/// A finished render and everything that its reports tell.
struct RenderResult {
    std::string scenePath, sceneHash;
    RenderSettings settings;
    FilmSums sums;
    EngineStatistics statistics;
    std::string device;
    double wallSeconds = 0, cpuSeconds = 0;  ///< of the iterations, without loading and building; CPU: all threads
    double setupSeconds = 0;                 ///< wall time to build the engine
    double finalRadius = 0;                  ///< merge radius of the last iteration, scene units
    bool interrupted = false;                ///< Ctrl-C ended it early

    /// All rays traced, shadow rays too.
    uint64_t totalRays() const { return statistics.rays + statistics.shadowRays; }
    double raysPerSecond() const { return wallSeconds > 0 ? double(totalRays()) / wallSeconds : 0; }
};

/// Renders iterations 1, 2, … until a limit of `options` or Ctrl-C, at least one. Throws Error.
RenderResult runRender(const RenderOptions& options, const Scene& scene);

}  // namespace antipode
