// Affine maps of meshes from a model's space into world space, in double precision.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// p ↦ x·p.x + y·p.y + z·p.z + offset.
struct Affine {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< images of the axes
    Vec3d offset{0, 0, 0};

    Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
    Vec3d point(const Vec3d& p) const { return vector(p) + offset; }
    double determinant() const { return dot(x, cross(y, z)); }
    bool operator==(const Affine&) const = default;

    /// The image of a surface normal, not normalised: the cofactor matrix with the determinant's sign.
    Vec3d normal(const Vec3d& n) const;
};

/// First `inner`, then `outer`.
Affine operator*(const Affine& outer, const Affine& inner);

Affine rotation(const Vec3d& unitAxis, double radians);

/// Maps positions, normals and tangents to world space; where the map mirrors, triangles are turned so that fronts stay
/// fronts. The identity leaves every bit as it is.
void transformMesh(Mesh& mesh, const Affine& map);

}  // namespace antipode
