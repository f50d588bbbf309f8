#include "scene/mesh_fronts.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace antipode {

std::array<uint32_t, 3> frontByNormals(const Mesh& mesh, const std::array<uint32_t, 3>& t) {
    if (mesh.normals.empty()) return t;
    const Vec3d p0(mesh.positions[t[0]]), p1(mesh.positions[t[1]]), p2(mesh.positions[t[2]]);
    const Vec3d sum = Vec3d(mesh.normals[t[0]]) + Vec3d(mesh.normals[t[1]]) + Vec3d(mesh.normals[t[2]]);
    return dot(cross(p1 - p0, p2 - p0), sum) < 0.0 ? std::array{t[0], t[2], t[1]} : t;
}

std::optional<double> enclosedVolume(const Mesh& mesh) {
    using Point = std::tuple<float, float, float>;
    std::map<Point, uint32_t> vertices;
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    double volume = 0;
    for (const auto& triangle : mesh.triangles) {
        const auto t = frontByNormals(mesh, triangle);
        std::array<uint32_t, 3> v;
        for (size_t k = 0; k < 3; ++k) {
            const Vec3f& p = mesh.positions[t[k]];
            v[k] = vertices.try_emplace({p.x, p.y, p.z}, uint32_t(vertices.size())).first->second;
        }
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = v[k], b = v[(k + 1) % 3];
            if (a != b) edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
        const Vec3d o(mesh.positions[mesh.triangles[0][0]]);
        volume += dot(Vec3d(mesh.positions[t[0]]) - o,
                      cross(Vec3d(mesh.positions[t[1]]) - o, Vec3d(mesh.positions[t[2]]) - o));
    }
    if (!std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; })) return {};
    return volume / 6;
}

bool isClosed(const Mesh& mesh) { return enclosedVolume(mesh).value_or(0) > 0; }

}  // namespace antipode
