// Coarse smooth triangles as curved patches: a pure function of the scene.
#include "gpu/curved_triangles.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "gpu/curved_edges.h"
#include "scene/mesh_fronts.h"
#include "tests/techniques/scenes.h"

namespace antipode {
namespace {

using test::addGeodesicSphere;

constexpr uint32_t matte = 0, glass = 1, lamp = 2, bumpy = 3;

Scene emptyScene() {
    Scene scene;
    scene.materials.resize(4);
    scene.materials[glass].kind = MaterialKind::Dielectric;
    scene.materials[lamp].emission = Vec3f(1.0f);
    scene.materials[bumpy].normalTexture = 0;
    return scene;
}

Scene smoothBall(uint32_t levels, uint32_t material = matte, Vec3f center = {}) {
    Scene scene = emptyScene();
    addGeodesicSphere(scene, center, 1, levels, true, false, material);
    return scene;
}

/// A closed cylinder of radius 1 about the y axis from 0 to `height`; smooth around, flat at its ends.
Mesh cylinder(uint32_t segments, float height) {
    Mesh mesh;
    const auto ring = [&](float y, const Vec3f* normal) {
        for (uint32_t s = 0; s < segments; ++s) {
            const double angle = 2 * std::numbers::pi * s / segments;
            const Vec3f out{float(std::cos(angle)), 0, float(std::sin(angle))};
            mesh.positions.push_back(out + Vec3f{0, y, 0});
            mesh.normals.push_back(normal != nullptr ? *normal : out);
        }
    };
    const Vec3f up{0, 1, 0}, down{0, -1, 0};
    ring(0, nullptr), ring(height, nullptr), ring(0, &down), ring(height, &up);
    for (uint32_t s = 0; s < segments; ++s) {
        const uint32_t t = (s + 1) % segments, n = segments;
        mesh.triangles.insert(mesh.triangles.end(), {{s, n + s, t}, {t, n + s, n + t}});
        if (s > 0 && t > 0)
            mesh.triangles.insert(mesh.triangles.end(), {{2 * n, 2 * n + s, 2 * n + t}, {3 * n, 3 * n + t, 3 * n + s}});
    }
    return mesh;
}

Mesh joined(const Mesh& a, const Mesh& b) {
    Mesh sum = a;
    const uint32_t first = uint32_t(a.positions.size());
    sum.positions.insert(sum.positions.end(), b.positions.begin(), b.positions.end());
    sum.normals.insert(sum.normals.end(), b.normals.begin(), b.normals.end());
    for (const auto& [i, j, k] : b.triangles) sum.triangles.push_back({first + i, first + j, first + k});
    return sum;
}

double distanceFromUnit(const Vec3f& p) { return std::abs(length(Vec3d(p)) - 1); }

/// The greatest angle between a facet and a normal at its corners, in degrees.
double greatestDeviation(const Mesh& mesh) {
    double least = 1;
    for (const auto& t : mesh.triangles) {
        const Vec3d p0(mesh.positions[t[0]]);
        const Vec3d facet = normalize(cross(Vec3d(mesh.positions[t[1]]) - p0, Vec3d(mesh.positions[t[2]]) - p0));
        for (const uint32_t i : t) least = std::min(least, dot(facet, Vec3d(mesh.normals[i])));
    }
    return std::acos(least) * 180 / std::numbers::pi;
}

std::set<std::array<float, 3>> placesOf(const Mesh& mesh) {
    std::set<std::array<float, 3>> places;
    for (const auto& t : mesh.triangles)
        for (const uint32_t i : t) places.insert({mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z});
    return places;
}

// --- One patch ---

CurvedEdge straight(const Vec3d& a, const Vec3d& b, uint32_t parts) {
    return {{a, a + (b - a) / 3.0, b - (b - a) / 3.0, b}, parts};
}

/// Whatever its edges are cut into, a patch covers its triangle once, without a gap, a fold or a triangle of no area.
TEST(CurvedPatch, CoversItsTriangleForEveryCutOfItsEdges) {
    const std::array<Vec3d, 3> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, normals{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
    const uint32_t cuts[]{1, 2, 4, 8, 16};
    for (const uint32_t a : cuts)
        for (const uint32_t b : cuts)
            for (const uint32_t c : cuts) {
                const CurvedPatch patch(corners, normals,
                                        {straight(corners[0], corners[1], a), straight(corners[0], corners[2], b),
                                         straight(corners[1], corners[2], c)});
                const auto [vertices, triangles] = patch.triangles();
                EXPECT_EQ(triangles.size(), patchTriangles({a, b, c}));
                double area = 0, least = 1;
                std::array<uint32_t, 3> onEdges{};
                for (const auto& t : triangles) {
                    const auto &p = vertices[t[0]].weights, &q = vertices[t[1]].weights, &r = vertices[t[2]].weights;
                    const double own = (q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1]);
                    area += own, least = std::min(least, own);
                }
                for (const auto& v : vertices) {
                    onEdges[0] += v.weights[2] == 0, onEdges[1] += v.weights[1] == 0, onEdges[2] += v.weights[0] == 0;
                    EXPECT_NEAR(length(v.position - Vec3d{v.weights[1], v.weights[2], 0}), 0, 1e-15);
                }
                EXPECT_EQ(area, 1) << a << " " << b << " " << c;
                EXPECT_GT(least, 0) << a << " " << b << " " << c;
                EXPECT_EQ(onEdges, (std::array{a + 1, b + 1, c + 1}));
            }
}

// --- Whole surfaces ---

/// Facets that deviate from their normals are the terminator's cause.
TEST(CurvedTriangles, FollowASphere) {
    const double greatestDistance[]{0.06, 0.0065, 4.5e-4, 1.8e-5};
    for (const uint32_t levels : {0u, 1u, 2u, 3u}) {
        const Scene scene = smoothBall(levels);
        const auto curved = curvedScene(scene);
        ASSERT_TRUE(curved) << levels;
        const Mesh& mesh = curved->meshes[0];
        EXPECT_EQ(mesh.triangles.size(), 5120u);
        EXPECT_TRUE(isClosed(mesh));
        double distance = 0;
        for (const Vec3f& p : mesh.positions) distance = std::max(distance, distanceFromUnit(p));
        EXPECT_LT(distance, greatestDistance[levels]);
        EXPECT_LT(greatestDeviation(mesh), levels == 0 ? 17 : 6) << levels;
        EXPECT_GT(greatestDeviation(scene.meshes[0]), 4) << levels;
    }
}

TEST(CurvedTriangles, LeaveDenseMeshesAlone) { EXPECT_FALSE(curvedScene(smoothBall(4))); }

TEST(CurvedTriangles, FollowACreaseAlongBothItsSides) {
    Scene scene = emptyScene();
    scene.meshes = {cylinder(12, 5)};
    ASSERT_TRUE(isClosed(scene.meshes[0]));
    const auto curved = curvedScene(scene);
    ASSERT_TRUE(curved);
    const Mesh& mesh = curved->meshes[0];
    EXPECT_TRUE(isClosed(mesh));
    EXPECT_GT(mesh.triangles.size(), 4 * scene.meshes[0].triangles.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3f &p = mesh.positions[i], &n = mesh.normals[i];
        if (std::abs(n.y) > 0.5f) {  // an end: flat, and round at its rim
            EXPECT_EQ(p.y, n.y > 0 ? 5 : 0);
            EXPECT_LE(std::hypot(p.x, p.z), 1.0005);
        } else {
            EXPECT_NEAR(std::hypot(p.x, p.z), 1, 0.002);
        }
    }
}

/// A ball in two meshes, as models are parted by material.
TEST(CurvedTriangles, AgreeAcrossMeshes) {
    Scene scene = smoothBall(1);
    scene.meshes.push_back(scene.meshes[0]);
    auto &first = scene.meshes[0].triangles, &second = scene.meshes[1].triangles;
    first.resize(27), second.erase(second.begin(), second.begin() + 27);
    const auto curved = curvedScene(scene);
    ASSERT_TRUE(curved);
    const Mesh whole = joined(curved->meshes[0], curved->meshes[1]);
    EXPECT_EQ(whole.triangles.size(), 5120u);
    EXPECT_TRUE(isClosed(whole));
}

/// Beside a part without normals, or one that must not change, the seam stays straight, and closed.
TEST(CurvedTriangles, StayStraightWhereTheOtherSideDoes) {
    for (const uint32_t material : {matte, lamp, bumpy}) {
        Scene scene = smoothBall(1);
        scene.meshes.push_back(scene.meshes[0]);
        scene.meshes[1].material = material;
        auto &first = scene.meshes[0].triangles, &second = scene.meshes[1].triangles;
        first.resize(27), second.erase(second.begin(), second.begin() + 27);
        if (material == matte) scene.meshes[1].normals.clear();
        const auto curved = curvedScene(scene);
        ASSERT_TRUE(curved);
        EXPECT_GT(curved->meshes[0].triangles.size(), 1000u);
        EXPECT_EQ(curved->meshes[1].triangles, second);
        Mesh bare = curved->meshes[0], other = curved->meshes[1];
        bare.normals.clear(), other.normals.clear();
        EXPECT_TRUE(isClosed(joined(bare, other)));
    }
}

TEST(CurvedTriangles, LeaveAloneWhatTheyMust) {
    EXPECT_FALSE(curvedScene(smoothBall(1, lamp))) << "its area is its power";
    EXPECT_FALSE(curvedScene(smoothBall(1, bumpy))) << "its normals are relative to the facets";
    Scene scene = emptyScene();
    scene.meshes = {cylinder(4, 1)};
    EXPECT_FALSE(curvedScene(scene)) << "a box with smooth normals around";
    scene.meshes = {cylinder(12, 1)};
    for (Vec3f& n : scene.meshes[0].normals) n = {0, 1, 0};
    EXPECT_FALSE(curvedScene(scene)) << "normals that have nothing to do with the facets";
    test::addHorizontalSquare(scene, {0, 0, 0}, 1, matte);
    scene.meshes = {scene.meshes.back()};
    scene.meshes[0].normals.assign(4, normalize(Vec3f{0.4f, 0.2f, 1}));
    EXPECT_FALSE(curvedScene(scene)) << "normals that lean but do not turn";
    scene = smoothBall(1);
    scene.meshes[0].triangles.resize(1);
    EXPECT_FALSE(curvedScene(scene)) << "borders";
}

/// Cut apart, faces of bodies in contact would no longer be one interface.
TEST(CurvedTriangles, LeaveBodiesInContactAlone) {
    Scene scene = smoothBall(1, glass);
    EXPECT_TRUE(curvedScene(scene));
    addGeodesicSphere(scene, {2.5f, 0, 0}, 1, 1, true, false, glass);
    EXPECT_EQ(curvedScene(scene)->meshes[1].triangles.size(), 5120u) << "apart";
    scene.meshes.pop_back();
    addGeodesicSphere(scene, {0, 0, 0}, 0.5f, 1, true, false, glass);
    EXPECT_FALSE(curvedScene(scene)) << "one within the other";
    scene.meshes.pop_back();
    scene.spheres = {{{1.4f, 0, 0}, 0.5f, glass}};
    EXPECT_FALSE(curvedScene(scene)) << "a sphere";
    scene.spheres.clear();
    Mesh cup = scene.meshes[0];
    cup.material = matte;
    scene.meshes.push_back(cup);
    EXPECT_FALSE(curvedScene(scene)) << "an opaque wall in its faces";
}

TEST(CurvedTriangles, GiveTheSameSurfaceForEitherWinding) {
    Scene scene = smoothBall(1);
    const auto curved = curvedScene(scene);
    for (auto& t : scene.meshes[0].triangles) std::swap(t[0], t[1]);
    for (Vec3f& n : scene.meshes[0].normals) n = -n;
    const auto turned = curvedScene(scene);
    ASSERT_TRUE(curved && turned);
    EXPECT_EQ(placesOf(curved->meshes[0]), placesOf(turned->meshes[0]));
    EXPECT_LT(greatestDeviation(turned->meshes[0]), 6) << "it keeps its side";
}

TEST(CurvedTriangles, InterpolateWhatVerticesHaveBesides) {
    Scene scene = smoothBall(1);
    Mesh& mesh = scene.meshes[0];
    for (const Vec3f& p : mesh.positions) mesh.uvs.push_back({2 * p.x + 1, p.y - p.z});
    const auto curved = curvedScene(scene);
    ASSERT_TRUE(curved);
    const Mesh& cut = curved->meshes[0];
    ASSERT_EQ(cut.uvs.size(), cut.positions.size());
    for (size_t i = 0; i < cut.uvs.size(); ++i) {  // at the facet's point, which lies within the sagitta
        EXPECT_NEAR(cut.uvs[i][0], 2 * cut.positions[i].x + 1, 0.2);
        EXPECT_NEAR(cut.uvs[i][1], cut.positions[i].y - cut.positions[i].z, 0.2);
    }
}

/// 200 balls of 5,120 triangles each would be a million.
TEST(CurvedTriangles, GrowWithinBounds) {
    Scene scene = emptyScene();
    for (int i = 0; i < 200; ++i) addGeodesicSphere(scene, {3.0f * float(i), 0, 0}, 1, 1, true, false, matte);
    uint64_t before = 0, after = 0;
    for (const Mesh& mesh : scene.meshes) before += mesh.triangles.size();
    const auto curved = curvedScene(scene);
    ASSERT_TRUE(curved);
    for (const Mesh& mesh : curved->meshes) {
        after += mesh.triangles.size();
        EXPECT_EQ(mesh.triangles.size(), 320u) << "as fine as the bound allows, and all alike";
    }
    EXPECT_LE(after - before, greatestCurvedTriangles(before));
    EXPECT_EQ(greatestCurvedTriangles(20), 20u * 255);
    EXPECT_EQ(greatestCurvedTriangles(uint64_t(1) << 60), uint64_t(1) << 17);
}

}  // namespace
}  // namespace antipode
