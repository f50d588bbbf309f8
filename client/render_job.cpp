#include "client/render_job.h"

#include <chrono>
#include <iostream>

#include <sys/resource.h>

#include "client/interrupt.h"
#include "client/progress.h"
#include "proto/scene_loader.h"

namespace antipode {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// User and system time of all threads of the process so far.
double processCpuSeconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

bool limitReached(const ProgressState& state) {
    return (state.iterationLimit && state.iterations >= *state.iterationLimit) ||
           (state.secondLimit && state.elapsedSeconds >= *state.secondLimit);
}

/// Large images on devices that bind little memory at once trace fewer light paths: unbiased, but worth knowing.
void noteFewerLightPaths(uint64_t lightPaths, const RenderSettings& settings) {
    const uint64_t pixels = uint64_t(settings.width) * settings.height;
    if (settings.lightPathCount || lightPaths == 0 || lightPaths >= pixels) return;
    std::cerr << "antipode: note: " << lightPaths << " light paths an iteration for " << pixels
              << " pixels: the device can bind the vertices of no more" << std::endl;
}

}  // namespace

RenderResult runRender(const RenderOptions& options, const Scene& scene) {
    RenderResult result;
    result.scenePath = options.scenePath;
    result.sceneHash = sceneHash(scene);
    result.settings = options.settings;
    resolveSize(options, scene, result.settings);

    const auto setupStart = Clock::now();
    Engine engine(scene, result.settings, options.device);
    result.setupSeconds = secondsSince(setupStart);
    result.device = engine.deviceName();
    noteFewerLightPaths(engine.statistics().lightPathsPerIteration, result.settings);

    ProgressState state;
    state.iterationLimit = options.iterations;
    state.secondLimit = options.seconds;
    {
        const InterruptGuard interrupt(!options.quiet);
        Progress progress(options.quiet);
        const double cpuStart = processCpuSeconds();
        const auto start = Clock::now();
        do {
            engine.render(++state.iterations);
            state.elapsedSeconds = secondsSince(start);
            if (!progress.due(state.elapsedSeconds)) continue;
            const EngineStatistics statistics = engine.statistics();
            state.rays = statistics.rays + statistics.shadowRays;
            progress.show(state);
        } while (!limitReached(state) && !interrupt.requested());
        result.wallSeconds = state.elapsedSeconds;
        result.cpuSeconds = processCpuSeconds() - cpuStart;
        result.interrupted = !limitReached(state);
    }
    result.sums = engine.sums();
    result.statistics = engine.statistics();
    result.finalRadius = mergeRadius(result.statistics.initialRadius, result.settings.alpha, state.iterations);
    return result;
}

}  // namespace antipode
