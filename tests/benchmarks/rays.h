// Rays that the device and Embree trace alike.
#pragma once

#include <vector>

#include "renderengine/scene.h"

namespace antipode::benchmark {

struct Ray {
    Vec3f origin, direction;  ///< direction of any length
};

class EmbreeScene;

/// Through the centres of a square image's pixels, row by row.
std::vector<Ray> primaryRays(const Camera& camera, uint32_t side);

/// From the points that the rays hit, on the side that they came from, cosine-distributed about the geometric normal;
/// in random order, so that neighbours have nothing in common. Origins lie off the surface by far more than its
/// rounding error, so that no tracer needs to know where a ray starts. The same on every machine but for rounding.
std::vector<Ray> shuffledDiffuseRays(const std::vector<Ray>& rays, const EmbreeScene& scene);

}  // namespace antipode::benchmark
