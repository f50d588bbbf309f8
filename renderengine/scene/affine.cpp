#include "scene/affine.h"

#include <cmath>
#include <utility>

namespace antipode {

Vec3d Affine::normal(const Vec3d& n) const {
    const Vec3d image = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return determinant() < 0 ? -image : image;
}

Affine operator*(const Affine& outer, const Affine& inner) {
    return {outer.vector(inner.x), outer.vector(inner.y), outer.vector(inner.z), outer.point(inner.offset)};
}

Affine rotation(const Vec3d& unitAxis, double radians) {
    // Rodrigues' formula, one image per axis.
    const double c = std::cos(radians), s = std::sin(radians);
    const auto turn = [&](const Vec3d& v) {
        return v * c + cross(unitAxis, v) * s + unitAxis * (dot(unitAxis, v) * (1 - c));
    };
    return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1}), {0, 0, 0}};
}

void transformMesh(Mesh& mesh, const Affine& map) {
    if (map == Affine{}) return;
    for (Vec3f& p : mesh.positions) p = Vec3f(map.point(Vec3d(p)));
    for (Vec3f& n : mesh.normals) n = Vec3f(normalize(map.normal(Vec3d(n))));
    for (auto& t : mesh.tangents) {
        const Vec3d image = map.vector(Vec3d(t[0], t[1], t[2]));
        const double size = length(image);
        if (size > 0) t = {float(image.x / size), float(image.y / size), float(image.z / size), t[3]};
    }
    if (map.determinant() < 0) {
        for (auto& t : mesh.tangents) t[3] = -t[3];
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
}

}  // namespace antipode
