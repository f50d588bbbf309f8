// What renders the iterations of one job: `Engine` on a device, and in tests one that counts.
#pragma once

#include <cstdint>
#include <functional>
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
class Renderer {
public:
    virtual ~Renderer() = default;

    /// Renders global iteration `iteration` ≥ 1 and adds it to the film. Throws Error(Device).
    virtual void render(uint64_t iteration) = 0;
    /// The sums of the iterations rendered since the last reset.
    virtual FilmSums sums() const = 0;
    /// Clears the film and the statistics of iterations.
    virtual void reset() = 0;
    virtual EngineStatistics statistics() const = 0;
};

/// Makes the renderer of a job. Throws Error.
using RendererFactory = std::function<std::unique_ptr<Renderer>(const Scene&, const RenderSettings&)>;

}  // namespace antipode
