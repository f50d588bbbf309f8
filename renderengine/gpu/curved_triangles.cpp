#include "gpu/curved_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gpu/body_contact.h"
#include "gpu/curved_edges.h"
#include "gpu/interfaces.h"
#include "gpu/pack_materials.h"
#include "scene/bounds.h"
#include "scene/mesh_fronts.h"
#include "scene/scene_fields.h"

namespace antipode {
namespace {

/// Memory of about 30 MB and a quarter of a second of set-up.
constexpr uint64_t mostAdded = 1u << 17;
/// The thresholds that are tried, each twice the one before: the last one is beyond the greatest bend.
constexpr size_t thresholds = 5;
double threshold(size_t k) { return leastBend * double(1u << k); }

/// The edges' ends among a triangle's corners.
constexpr std::array<std::array<size_t, 2>, 3> ends{{{0, 1}, {0, 2}, {1, 2}}};

bool isDegenerate(const Mesh& mesh, const std::array<uint32_t, 3>& t) {
    const Vec3d p0(mesh.positions[t[0]]);
    return cross(Vec3d(mesh.positions[t[1]]) - p0, Vec3d(mesh.positions[t[2]]) - p0) == Vec3d{};
}

/// Whether the triangle's vertex normals look to one side of it and are those of a surface that it approximates.
bool fitsNormals(const Mesh& mesh, const std::array<uint32_t, 3>& t) {
    const Vec3d p0(mesh.positions[t[0]]);
    const Vec3d facet = cross(Vec3d(mesh.positions[t[1]]) - p0, Vec3d(mesh.positions[t[2]]) - p0);
    double least = 1, greatest = -1;
    for (const uint32_t i : t) {
        const double cosine = dot(facet, Vec3d(mesh.normals[i])) / length(facet);
        least = std::min(least, cosine), greatest = std::max(greatest, cosine);
    }
    return least >= 0.5 || greatest <= -0.5;
}

double bendOf(const Mesh& mesh, uint32_t a, uint32_t b) {
    return bend(Vec3d(mesh.positions[a]), Vec3d(mesh.positions[b]), Vec3d(mesh.normals[a]), Vec3d(mesh.normals[b]));
}

/// How many triangles the mesh's own normals ask for at each threshold, in excess of what it has.
using Growth = std::array<uint64_t, thresholds>;
Growth growthOf(const Mesh& mesh) {
    Growth growth{};
    for (const auto& t : mesh.triangles) {
        std::array<double, 3> bends;
        for (size_t e = 0; e < 3; ++e) bends[e] = bendOf(mesh, t[ends[e][0]], t[ends[e][1]]);
        if (std::max({bends[0], bends[1], bends[2]}) <= leastBend || isDegenerate(mesh, t) || !fitsNormals(mesh, t))
            continue;
        for (size_t k = 0; k < thresholds; ++k)
            growth[k] += patchTriangles({partsOf(bends[0], threshold(k)), partsOf(bends[1], threshold(k)),
                                         partsOf(bends[2], threshold(k))}) -
                         1;
    }
    return growth;
}

bool mayBend(const Scene& scene, const Mesh& mesh) {
    const Material& m = scene.materials[mesh.material];
    // Of further texture coordinates addVertex() can keep one set: they lie set after set.
    return !mesh.normals.empty() && !m.emits() && !m.normalTexture && !isHole(m) &&
           mesh.moreUvs.size() <= mesh.positions.size();
}

/// Whether faces of the mesh and of a closed transparent body may be one interface (gpu/interfaces.h): cut apart they
/// would no longer be.
bool isInContact(const Scene& scene, size_t index) {
    const auto isTransparentIn = [&](uint32_t material) { return isTransparent(scene.materials[material]); };
    const Mesh& mesh = scene.meshes[index];
    const Bounds3d bounds = boundsOf(mesh);
    const auto isNear = [&](const Bounds3d& other) { return boxesMeet(bounds, other, contactSlack(bounds, other)); };
    const bool own = isTransparentIn(mesh.material);
    if (own && !isClosed(mesh)) return false;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& other = scene.meshes[i];
        const bool others = isTransparentIn(other.material);
        if (i == index || other.triangles.empty() || !(own || others) || !isNear(boundsOf(other))) continue;
        if (others && !isClosed(other)) continue;
        if (own && others ? bodiesMeet(&mesh, &other) : sharesPlane(own ? mesh : other, own ? other : mesh))
            return true;
    }
    return own && std::ranges::any_of(scene.spheres, [&](const Sphere& sphere) {
               return isTransparentIn(sphere.material) && bodiesMeet(&mesh, &sphere);
           });
}

/// Calls visit(triangle, its number) for those that can be seen.
template <class Visit>
void forEachTriangle(const Mesh& mesh, const Visit& visit) {
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        if (!isDegenerate(mesh, mesh.triangles[i])) visit(mesh.triangles[i], i);
}

/// Which meshes may be cut apart. Contact is asked for only where it matters.
std::vector<bool> bendingMeshes(const Scene& scene, const std::vector<Growth>& growths) {
    std::vector<bool> bending(scene.meshes.size());
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (!mayBend(scene, mesh)) continue;
        bending[m] = growths[m][0] > 0 ? !isInContact(scene, m) : !isTransparent(scene.materials[mesh.material]);
    }
    return bending;
}

CurvedEdges findCurves(const Scene& scene, const std::vector<bool>& bending, double leastWanted) {
    CurvedEdges curves;
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        if (!bending[m]) continue;
        const Mesh& mesh = scene.meshes[m];
        forEachTriangle(mesh, [&](const auto& t, size_t) {
            for (const auto& [a, b] : ends)
                if (bendOf(mesh, t[a], t[b]) > leastWanted) curves.want(mesh.positions[t[a]], mesh.positions[t[b]]);
        });
    }
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        forEachTriangle(mesh, [&](const auto& t, size_t) {
            const bool fits = bending[m] && fitsNormals(mesh, t);
            for (const auto& [a, b] : ends) {
                const uint32_t i = t[a], j = t[b];
                std::optional<CurvedEdges::Normals> normals;
                if (fits) normals = {mesh.normals[i], mesh.normals[j]};
                curves.meet(mesh.positions[i], mesh.positions[j], normals);
            }
        });
    }
    return curves;
}

/// A triangle's corners from the least to the greatest, so that the same patch comes of either winding.
struct Sorted {
    std::array<uint32_t, 3> corners;
    bool turned;  ///< against the triangle

    Sorted(const Mesh& mesh, const std::array<uint32_t, 3>& t) : corners(t), turned(false) {
        for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
            if (!isBefore(mesh.positions[corners[size_t(b)]], mesh.positions[corners[size_t(a)]])) continue;
            std::swap(corners[size_t(a)], corners[size_t(b)]);
            turned = !turned;
        }
    }
};

std::array<CurvedEdge, 3> edgesOf(const Mesh& mesh, const Sorted& t, const CurvedEdges& curves, double least) {
    std::array<CurvedEdge, 3> edges;
    for (size_t e = 0; e < 3; ++e)
        edges[e] = curves.edge(mesh.positions[t.corners[ends[e][0]]], mesh.positions[t.corners[ends[e][1]]], least);
    return edges;
}

uint64_t addedTriangles(const Scene& scene, const CurvedEdges& curves, double least) {
    uint64_t added = 0;
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.normals.empty()) continue;
        forEachTriangle(mesh, [&](const auto& t, size_t) {
            const auto edges = edgesOf(mesh, Sorted(mesh, t), curves, least);
            added += patchTriangles({edges[0].parts, edges[1].parts, edges[2].parts}) - 1;
        });
    }
    return added;
}

Vec3f weighted(const std::array<Vec3f, 3>& values, const std::array<double, 3>& weights) {
    return Vec3f(Vec3d(values[0]) * weights[0] + Vec3d(values[1]) * weights[1] + Vec3d(values[2]) * weights[2]);
}
template <size_t N>
std::array<float, N> weighted(const std::array<std::array<float, N>, 3>& values, const std::array<double, 3>& weights) {
    std::array<float, N> sum;
    for (size_t i = 0; i < N; ++i)
        sum[i] = float(double(values[0][i]) * weights[0] + double(values[1][i]) * weights[1] +
                       double(values[2][i]) * weights[2]);
    return sum;
}

/// Adds a vertex to the mesh; what it has beside position and normal is interpolated.
void addVertex(Mesh& mesh, const std::array<uint32_t, 3>& corners, const CurvedPatch::Vertex& vertex) {
    const size_t count = mesh.positions.size();
    forEachField(mesh, [&](auto, auto& values) {
        if constexpr (requires { weighted(std::array{values[0], values[0], values[0]}, vertex.weights); })
            if (values.size() == count)
                values.push_back(
                    weighted(std::array{values[corners[0]], values[corners[1]], values[corners[2]]}, vertex.weights));
    });
    mesh.positions.back() = Vec3f(vertex.position);
    mesh.normals.back() = Vec3f(vertex.normal);
}

/// Replaces the mesh's triangle by those of the patch, the first in its place.
void cut(Mesh& mesh, size_t index, const Sorted& t, const CurvedPatch::Triangles& patch) {
    std::vector<uint32_t> vertices(t.corners.begin(), t.corners.end());
    for (size_t i = vertices.size(); i < patch.vertices.size(); ++i) {
        vertices.push_back(uint32_t(mesh.positions.size()));
        addVertex(mesh, t.corners, patch.vertices[i]);
    }
    for (size_t i = 0; i < patch.triangles.size(); ++i) {
        auto [a, b, c] = patch.triangles[i];
        if (t.turned) std::swap(b, c);
        const std::array triangle{vertices[a], vertices[b], vertices[c]};
        if (i == 0)
            mesh.triangles[index] = triangle;
        else
            mesh.triangles.push_back(triangle);
    }
}

void curve(Mesh& mesh, const CurvedEdges& curves, double least) {
    const size_t count = mesh.triangles.size();
    for (size_t i = 0; i < count; ++i) {
        if (isDegenerate(mesh, mesh.triangles[i])) continue;
        const Sorted t(mesh, mesh.triangles[i]);
        const auto edges = edgesOf(mesh, t, curves, least);
        if (edges[0].parts * edges[1].parts * edges[2].parts == 1) continue;
        std::array<Vec3d, 3> corners, normals;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = Vec3d(mesh.positions[t.corners[k]]);
            normals[k] = Vec3d(mesh.normals[t.corners[k]]);
        }
        cut(mesh, i, t, CurvedPatch(corners, normals, edges).triangles());
    }
}

}  // namespace

std::optional<Scene> curvedScene(const Scene& scene) {
    std::vector<Growth> growths(scene.meshes.size(), Growth{});
    for (size_t m = 0; m < scene.meshes.size(); ++m)
        if (mayBend(scene, scene.meshes[m])) growths[m] = growthOf(scene.meshes[m]);
    if (std::ranges::all_of(growths, [](const Growth& growth) { return growth[0] == 0; })) return {};

    const std::vector<bool> bending = bendingMeshes(scene, growths);
    for (size_t k = 0; k < thresholds; ++k) {
        uint64_t wanted = 0;
        for (size_t m = 0; m < growths.size(); ++m) wanted += bending[m] ? growths[m][k] : 0;
        if (wanted == 0) return {};
        if (wanted > mostAdded) continue;
        // A crease that one side asks to be curved cuts the other side, too.
        const CurvedEdges curves = findCurves(scene, bending, threshold(k));
        const uint64_t added = addedTriangles(scene, curves, threshold(k));
        if (added == 0) return {};
        if (added > mostAdded) continue;
        Scene curved = scene;
        for (size_t m = 0; m < curved.meshes.size(); ++m)
            if (bending[m]) curve(curved.meshes[m], curves, threshold(k));
        return curved;
    }
    return {};
}

uint64_t greatestCurvedTriangles(uint64_t triangles) {
    constexpr uint64_t perTriangle = uint64_t(CurvedPatch::mostParts) * CurvedPatch::mostParts - 1;
    return triangles > mostAdded / perTriangle ? mostAdded : triangles * perTriangle;
}

}  // namespace antipode
