// Rays, frames and brute-force intersection of the reference renderer: double precision, no acceleration structure, no
// absolute epsilon. A ray that starts on a primitive names it, and that primitive is intersected knowing it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "renderengine/scene.h"

namespace antipode::reference {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A right-handed orthonormal basis whose z axis is `normal` (unit) (Duff et al. 2017).
struct Frame {
    explicit Frame(const Vec3d& normal);
    Vec3d toWorld(const Vec3d& local) const { return tangent * local.x + bitangent * local.y + normal * local.z; }
    Vec3d toLocal(const Vec3d& world) const { return {dot(world, tangent), dot(world, bitangent), dot(world, normal)}; }
    Vec3d tangent, bitangent, normal;
};

using PrimitiveId = uint32_t;
constexpr PrimitiveId kNoPrimitive = ~0u;

struct Ray {
    Vec3d origin;
    Vec3d direction;                      ///< unit
    PrimitiveId startsOn = kNoPrimitive;  ///< the primitive whose surface holds the origin
};

struct Hit {
    double distance = 0;
    Vec3d position;
    Vec3d normal;  ///< unit, on the front side
    PrimitiveId primitive = kNoPrimitive;
    uint32_t material = 0;
};

struct TrianglePrimitive {
    Vec3d a, b, c;
    uint32_t material = 0;
    Vec3d normal() const { return normalize(cross(b - a, c - a)); }
    double area() const { return 0.5 * length(cross(b - a, c - a)); }
};

struct SpherePrimitive {
    Vec3d center;
    double radius = 1;
    uint32_t material = 0;
};

/// The surfaces of a scene: triangles first, then spheres; a PrimitiveId counts through both.
class Geometry {
public:
    /// Shading normals are not supported: throws Error(Usage) where a mesh has some.
    explicit Geometry(const Scene& scene);

    std::optional<Hit> intersect(const Ray& ray) const;
    /// Is the open segment from the ray's origin to `distance` (may be infinite) along it blocked? `endsOn` is the
    /// primitive that holds the end.
    bool occluded(const Ray& ray, double distance, PrimitiveId endsOn = kNoPrimitive) const;

    const std::vector<TrianglePrimitive>& triangles() const { return triangles_; }
    const std::vector<SpherePrimitive>& spheres() const { return spheres_; }
    PrimitiveId sphereId(size_t index) const { return PrimitiveId(triangles_.size() + index); }
    Vec3d boundingCenter() const { return boundingCenter_; }
    /// Radius of a sphere about boundingCenter() that holds every surface.
    double boundingRadius() const { return boundingRadius_; }

private:
    std::optional<double> intersectPrimitive(const Ray& ray, PrimitiveId id) const;

    std::vector<TrianglePrimitive> triangles_;
    std::vector<SpherePrimitive> spheres_;
    Vec3d boundingCenter_;
    double boundingRadius_ = 0;
};

}  // namespace antipode::reference
