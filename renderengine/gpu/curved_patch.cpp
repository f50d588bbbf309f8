#include "gpu/curved_patch.h"

#include <algorithm>

namespace antipode {
namespace {

/// Corners of the edges.
constexpr std::array<std::array<size_t, 2>, 3> ends{{{0, 1}, {0, 2}, {1, 2}}};

uint32_t mostOf(const std::array<uint32_t, 3>& parts) { return std::max({parts[0], parts[1], parts[2]}); }

/// The grid point to which the i-th of `all` moves along an edge that is cut into fewer `parts`: the nearest vertex, of
/// two the one nearer to an end, from the very middle to the end where the other edge of a corner does not go (`up`),
/// so that no triangle loses its area without vanishing.
uint32_t snapped(uint32_t i, uint32_t all, uint32_t parts, bool up) {
    const uint32_t step = all / parts, below = i / step, over = i % step;
    const bool further = 2 * over > step || (2 * over == step && (2 * i > all || (2 * i == all && up)));
    return (below + (further ? 1 : 0)) * step;
}

}  // namespace

Vec3d CurvedEdge::point(uint32_t j) const {
    const double t = double(j) / parts, s = 1 - t;
    return controls[0] * (s * s * s) + controls[1] * (3 * s * s * t) + controls[2] * (3 * s * t * t) +
           controls[3] * (t * t * t);
}

CurvedPatch::CurvedPatch(const std::array<Vec3d, 3>& corners, const std::array<Vec3d, 3>& normals,
                         const std::array<CurvedEdge, 3>& edges)
    : corners_(corners),
      normals_(normals),
      edges_(edges),
      parts_(mostOf({edges[0].parts, edges[1].parts, edges[2].parts})) {
    Vec3d onEdges;
    for (size_t e = 0; e < 3; ++e) {
        onEdges += edges[e].controls[1] + edges[e].controls[2];
        const auto [a, b] = ends[e];
        // Quadratic normals: linear along arcs and straight edges, and in an inflected curve's middle its own, which
        // turns back by half of what its ends are turned by.
        const Vec3d sum = normals[a] + normals[b];
        middleNormals_[e] = sum * 0.5;
        if (edges[e].parts == 1) continue;
        const Vec3d along = normalize(corners[b] - corners[a]);
        middleNormals_[e] += along * (-1.5 * dot(sum, along));
    }
    const Vec3d mean = onEdges / 6.0, flat = (corners[0] + corners[1] + corners[2]) / 3.0;
    middle_ = mean + (mean - flat) * 0.5;
}

CurvedPatch::Vertex CurvedPatch::vertexAt(uint32_t i, uint32_t j) const {
    const double v = double(i) / parts_, w = double(j) / parts_, u = double(parts_ - i - j) / parts_;
    const auto onEdge = [&](size_t e, uint32_t at) { return edges_[e].point(at * edges_[e].parts / parts_); };
    const auto inside = [&] {
        const auto &a = edges_[0].controls, &b = edges_[1].controls, &c = edges_[2].controls;
        return corners_[0] * (u * u * u) + corners_[1] * (v * v * v) + corners_[2] * (w * w * w) +
               (a[1] * u + a[2] * v) * (3 * u * v) + (b[1] * u + b[2] * w) * (3 * u * w) +
               (c[1] * v + c[2] * w) * (3 * v * w) + middle_ * (6 * u * v * w);
    };
    const Vec3d position = j == 0 ? onEdge(0, i) : i == 0 ? onEdge(1, j) : i + j == parts_ ? onEdge(2, j) : inside();
    const Vec3d normal = normals_[0] * (u * u) + normals_[1] * (v * v) + normals_[2] * (w * w) +
                         middleNormals_[0] * (2 * u * v) + middleNormals_[1] * (2 * u * w) +
                         middleNormals_[2] * (2 * v * w);
    return {{u, v, w}, position, normalize(normal)};
}

/// A uniform grid of as many parts as the finest edge has. Along the others its points move together, so that each
/// edge is cut as both its sides know it; what loses its area is left out.
CurvedPatch::Triangles CurvedPatch::triangles() const {
    const uint32_t n = parts_;
    Triangles result;
    constexpr uint32_t none = ~0u;
    std::vector<uint32_t> index(size_t(n + 1) * (n + 1), none);
    const auto place = [&](uint32_t i, uint32_t j) {
        if (j == 0)
            i = snapped(i, n, edges_[0].parts, true);
        else if (i == 0)
            j = snapped(j, n, edges_[1].parts, false);
        else if (i + j == n)
            j = snapped(j, n, edges_[2].parts, true), i = n - j;
        uint32_t& at = index[size_t(j) * (n + 1) + i];
        if (at == none) {
            at = uint32_t(result.vertices.size());
            result.vertices.push_back(vertexAt(i, j));
        }
        return at;
    };
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        if (a != b && b != c && c != a) result.triangles.push_back({a, b, c});
    };
    place(0, 0), place(n, 0), place(0, n);
    for (uint32_t j = 0; j < n; ++j) {
        for (uint32_t i = 0; i + j < n; ++i) {
            add(place(i, j), place(i + 1, j), place(i, j + 1));
            if (i + j + 1 < n) add(place(i + 1, j), place(i + 1, j + 1), place(i, j + 1));
        }
    }
    return result;
}

uint64_t patchTriangles(const std::array<uint32_t, 3>& parts) {
    const uint64_t most = mostOf(parts);
    return most * most - (3 * most - parts[0] - parts[1] - parts[2]);
}

}  // namespace antipode
