// The same triangles in Embree.
#pragma once

#include <limits>
#include <span>

#include <embree3/rtcore.h>

#include "tests/benchmarks/rays.h"

namespace antipode::benchmark {

struct EmbreeHit {
    bool found = false;
    float distance = std::numeric_limits<float>::infinity();  ///< in units of the direction's length
    Vec3f normal;                                             ///< unit, geometric
};

/// Embree with its defaults: the fast, not the watertight, intersector over its own tree.
class EmbreeScene {
public:
    /// Takes the scene's meshes; spheres are left out. Throws Error(Device).
    explicit EmbreeScene(const Scene& scene);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Wall seconds that the tree took.
    double buildSeconds() const { return buildSeconds_; }

    EmbreeHit closestHit(const Ray& ray) const;
    /// Traces the rays one by one (rtcIntersect1) on two threads that take a half each, as a CPU device of two cores
    /// does. `distances` has the rays' number of places; infinity where nothing is hit.
    void trace(std::span<const Ray> rays, std::span<float> distances) const;

private:
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    double buildSeconds_ = 0;
};

}  // namespace antipode::benchmark
