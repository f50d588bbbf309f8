// The reference path tracer: what a render must converge to. Slow, double precision, independent of the kernels.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "support/reference/bsdf.h"
#include "support/reference/camera.h"
#include "support/reference/lights.h"
#include "support/statistics.h"

namespace antipode::reference {

struct PathTracerOptions {
    bool nextEvent = true;       ///< false: emitters are only hit by scattered rays (naive path tracing)
    uint32_t minPathLength = 1;  ///< edges; shorter paths contribute nothing
    uint32_t maxPathLength = std::numeric_limits<uint32_t>::max();
    /// Survival rouletteSurvival(material) at every vertex. Off only with a maxPathLength.
    bool russianRoulette = true;
};

/// Moments of one pixel's or one ray's radiance, per channel.
struct RadianceMoments {
    Moments r, g, b;
    void add(const Vec3d& radiance);
    Vec3d mean() const { return {r.mean(), g.mean(), b.mean()}; }
    Vec3d meanVariance() const { return {r.meanVariance(), g.meanVariance(), b.meanVariance()}; }
};

class PathTracer {
public:
    /// Keeps a copy of the scene. Throws Error(Usage) for what the reference does not support.
    explicit PathTracer(Scene scene);

    /// One estimate of the radiance that arrives against the ray.
    Vec3d radiance(const Ray& ray, const PathTracerOptions& options, Random& random) const;
    /// Moments of `samples` estimates along one ray.
    RadianceMoments radianceMoments(const Ray& ray, const PathTracerOptions& options, uint64_t samples,
                                    uint64_t seed) const;
    /// Moments of every pixel (row 0 on top), `samples` each, positions uniform over the pixel.
    std::vector<RadianceMoments> image(uint32_t width, uint32_t height, const PathTracerOptions& options,
                                       uint64_t samples, uint64_t seed) const;

    const Scene& scene() const { return scene_; }
    const Geometry& geometry() const { return geometry_; }
    const LightSet& lights() const { return lights_; }

private:
    Vec3d nextEvent(const Hit& hit, const Frame& frame, const Vec3d& wo, const PathTracerOptions& options,
                    Random& random) const;
    double nextEventPdf(const Light& light, double pick, const LightPoint& point, double distance) const;

    Scene scene_;
    Geometry geometry_;
    LightSet lights_;
};

}  // namespace antipode::reference
