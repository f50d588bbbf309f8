// Closest hits on the host, in double.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/bvh.h"
#include "renderengine/scene.h"

namespace antipode {

/// All surfaces of a scene but those that alpha takes away whole, in units of 2^unitExponent(scene). The scene outlives
/// it.
class HostTracer {
public:
    /// Builds a BVH. Throws Error as buildBvh().
    explicit HostTracer(const Scene& scene);

    struct Hit {
        double distance = 0;
        uint32_t surface = 0;   ///< a triangle or a sphere of the tracer
        uint32_t material = 0;  ///< of the scene
        Vec3d normal;           ///< unit, of the front face
    };
    /// The nearest surface along the ray (`direction` unit) but `left`, or a sphere's other side; of those equally near
    /// the first in the scene, so that the BVH's shape does not show.
    std::optional<Hit> closest(const Vec3d& origin, const Vec3d& direction, std::optional<uint32_t> left) const;

    double unit() const { return unit_; }  ///< one scene unit

private:
    struct Triangle {
        uint32_t mesh, triangle;
    };

    std::optional<double> distanceTo(uint32_t surface, const Vec3d& origin, const Vec3d& direction,
                                     std::optional<uint32_t> left) const;
    std::array<Vec3d, 3> verticesOf(const Triangle& t) const;
    Hit describe(uint32_t surface, double distance, const Vec3d& point) const;

    const Scene& scene_;
    double unit_;
    std::vector<Triangle> triangles_;
    std::vector<uint32_t> spheres_;
    Bvh bvh_;
};

}  // namespace antipode
