// The engine: renders iterations of one job on one device.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "renderengine/film.h"
#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode {

/// Device time of one stage, from timestamp queries, summed over the iterations since the last reset.
struct StageTime {
    std::string stage;
    double seconds = 0;
    uint64_t rays = 0;  ///< rays traced by this stage, 0 where it traces none
};

struct EngineStatistics {
    std::vector<StageTime> stages;
    uint64_t rays = 0, shadowRays = 0, lightVertices = 0;
    uint64_t lightPathsPerIteration = 0;  ///< fewer than pixels where the device cannot bind the vertices of more
    double bvhBuildSeconds = 0;
    uint64_t bvhPrimitives = 0, deviceBytes = 0;
    double initialRadius = 0;
};

/// Not thread-safe: one thread at a time. Iteration i is a pure function of (scene, settings, i), so that iterations
/// can be rendered in any order and anywhere; the film holds exact integer sums of those rendered since the last reset.
class Engine {
public:
    /// Validates the scene, builds what it needs on the device that `deviceSelector` names ("" = the best one).
    /// Throws Error.
    Engine(const Scene& scene, const RenderSettings& settings, const std::string& deviceSelector = "");
    ~Engine();
    Engine(Engine&&) noexcept;
    Engine& operator=(Engine&&) noexcept;

    /// Renders global iteration `iteration` ≥ 1 and adds it to the film.
    void render(uint64_t iteration);
    /// The sums of the iterations rendered since the last reset.
    FilmSums sums() const;
    void reset();

    EngineStatistics statistics() const;
    std::string deviceName() const;
    /// What the Vulkan validation layer has said since the engine was made; always empty unless the environment
    /// variable ANTIPODE_VALIDATION switched the layer on ("1", or "sync" for missing barriers as well).
    std::vector<std::string> validationMessages() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The merge radius of global iteration i ≥ 1: r_1·i^((α−1)/2), in double (Knaus & Zwicker 2011).
double mergeRadius(double initialRadius, double alpha, uint64_t iteration);

}  // namespace antipode
