// lib/traversal.glsl against brute force in double precision, and what makes traversal robust: watertight meshes, empty
// BVH slots, degenerate primitives, scaling by powers of two. Fixed seeds; nothing here is a statistical test.
#include <cmath>

#include "support/hard_case.h"
#include "tests/kernels/distance_error.h"
#include "tests/kernels/tracer.h"

namespace antipode {
namespace {

using shared::NO_INDEX;

class IntersectionTest : public DeviceTest {
protected:
    /// Every ray's hit must be the reference's: the same primitive, at a distance within the bound of `distanceError`;
    /// where primitives lie closer together than their bounds, any of them. A ray within rounding of an edge may go
    /// either way: it passes where the reference agrees for a ray turned by 10⁻⁶.
    void expectBruteForce(const std::string& difficulty, Tracer& tracer, const std::vector<TracedRay>& rays) {
        const reference::Geometry geometry(tracer.scene());
        const auto hits = tracer.closest(rays);
        const auto any = tracer.any(rays);
        uint32_t hitCount = 0, edgeCases = 0, wrong = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].any(), any[i].any()) << "any hit differs from closest hit, ray " << i;
            hitCount += hits[i].any();
            if (agrees(geometry, rays[i], hits[i], Vec3d())) continue;
            ++edgeCases;
            if (explained(geometry, rays[i], hits[i])) continue;
            if (++wrong <= 5)
                ADD_FAILURE() << "ray " << i << " from " << rays[i].origin.x << " " << rays[i].origin.y << " "
                              << rays[i].origin.z << " along " << rays[i].direction.x << " " << rays[i].direction.y
                              << " " << rays[i].direction.z << " got primitive " << int(hits[i].primitive) << " at "
                              << hits[i].t;
        }
        expectWithin({"Intersection", difficulty, "rays that rounding does not explain, against brute force", 0}, wrong,
                     device->info().name);
        EXPECT_LE(edgeCases, 3 + rays.size() / 2000);
        EXPECT_GT(hitCount, 0u);
        EXPECT_EQ(tracer.events(EventKind::LoopLimit), 0u);
    }

private:
    static bool agrees(const reference::Geometry& geometry, const TracedRay& ray, const TracedHit& hit,
                       const Vec3d& jitter) {
        const double speed = length(Vec3d(ray.direction));
        const reference::Ray exact{Vec3d(ray.origin), normalize(Vec3d(ray.direction) / speed + jitter), ray.startsOn};
        const auto expected = geometry.intersect(exact);
        const double end = double(ray.tMax) * speed;
        if (!hit.any())
            return !expected || expected->distance > end - distanceError(geometry, exact, expected->primitive);
        const auto distance = exactDistance(geometry, exact, hit.primitive);
        if (!distance || !expected) return false;
        const double error = distanceError(geometry, exact, hit.primitive);
        return std::abs(hit.t * speed - *distance) <= error &&
               *distance <= expected->distance + error + distanceError(geometry, exact, expected->primitive);
    }

    static bool explained(const reference::Geometry& geometry, const TracedRay& ray, const TracedHit& hit) {
        Random random(7);
        for (int k = 0; k < 64; ++k)
            if (agrees(geometry, ray, hit, randomDirection(random) * 1e-6)) return true;
        return false;
    }
};

std::vector<TracedRay> randomRays(size_t count, double spread, Random& random) {
    std::vector<TracedRay> rays;
    for (size_t i = 0; i < count; ++i) {
        const Vec3d origin = randomDirection(random) * (spread * random.uniform());
        rays.push_back({Vec3f(origin), Vec3f(randomDirection(random))});
        if (i % 4 == 0) rays.back().tMax = float(std::pow(10.0, random.uniform(-2, 1)));
    }
    return rays;
}

TEST_F(IntersectionTest, EqualsBruteForceOnRandomSoups) {
    Random random(1);
    Tracer tracer(*device, randomSoup(500, 100, random));
    expectBruteForce("500 triangles and 100 spheres through each other", tracer, randomRays(100000, 2.0, random));
}

TEST_F(IntersectionTest, EqualsBruteForceWithHugeBesideTiny) {
    Random random(2);
    Scene scene = randomSoup(50, 0, random);
    scene = scaled(scene, 1e-3f);
    addTriangle(scene, {-1e5f, -0.1f, -1e5f}, {1e5f, -0.1f, -1e5f}, {0, -0.1f, 1e5f});
    addTriangle(scene, {-1e5f, -1e5f, 50}, {1e5f, -1e5f, 50}, {0, 1e5f, 51});
    scene.spheres.push_back({{0, 0, 200}, 100, 0});
    scene.spheres.push_back({{0.001f, 0.0005f, 0}, 1e-4f, 0});
    Tracer tracer(*device, scene);
    expectBruteForce("triangles of 2·10⁵ beside ones of 10⁻³", tracer, randomRays(20000, 5e-3, random));
}

/// Directions whose components are equal, or zero of either sign.
std::vector<Vec3f> specialDirections() {
    const float third = 1 / std::sqrt(3.0f), half = 1 / std::sqrt(2.0f);
    std::vector<Vec3f> directions;
    for (float x : {-1.0f, -0.0f, 0.0f, 1.0f})
        for (float y : {-1.0f, -0.0f, 0.0f, 1.0f})
            for (float z : {-1.0f, -0.0f, 0.0f, 1.0f}) {
                const int count = (x != 0) + (y != 0) + (z != 0);
                const float s = count == 3 ? third : count == 2 ? half : 1;
                if (count > 0)
                    directions.push_back({std::copysign(x * s, x), std::copysign(y * s, y), std::copysign(z * s, z)});
            }
    return directions;
}

// An empty slot's box lies on the space diagonal, where a ray with equal components points at it.
TEST_F(IntersectionTest, EmptySlotsNeverEndTheTraversal) {
    Random random(3);
    for (uint32_t primitives : {1u, 2u, 3u, 5u, 6u, 9u, 30u}) {
        Tracer tracer(*device, randomSoup(primitives, primitives / 3, random));
        std::vector<TracedRay> rays;
        const reference::Geometry geometry(tracer.scene());
        for (const Vec3f& direction : specialDirections())
            for (int k = 0; k < 40; ++k) {
                // Aimed at a point of a primitive, from up to 30 away.
                const auto& t = geometry.triangles()[random.index(uint32_t(geometry.triangles().size()))];
                const double u = random.uniform(), v = random.uniform() * (1 - u);
                const Vec3d target = t.a + (t.b - t.a) * u + (t.c - t.a) * v;
                rays.push_back({Vec3f(target - Vec3d(direction) * std::pow(10.0, random.uniform(-2, 1.5))), direction});
            }
        SCOPED_TRACE(primitives);
        expectBruteForce("few primitives, directions on axes and diagonals", tracer, rays);
    }
}

TEST_F(IntersectionTest, AxisParallelRaysMeetAxisParallelQuads) {
    Scene scene = emptyScene();
    for (int k = 0; k < 20; ++k) {
        const float z = float(k) * 0.25f;
        addTriangle(scene, {0, 0, z}, {1, 0, z}, {1, 1, z});
        addTriangle(scene, {0, 0, z}, {1, 1, z}, {0, 1, z});
    }
    Tracer tracer(*device, scene);
    std::vector<TracedRay> rays;
    // On the common diagonal, on borders, inside; at either sign of zero.
    for (float x : {0.0f, 0.25f, 0.5f, 1.0f})
        for (float y : {0.0f, 0.25f, 0.5f, 1.0f})
            for (float zero : {0.0f, -0.0f})
                for (float side : {-1.0f, 1.0f}) rays.push_back({{x, y, side * 20}, {zero, -zero, -side}});
    for (const TracedHit& hit : tracer.closest(rays)) EXPECT_TRUE(hit.any());
}

TEST_F(IntersectionTest, DegenerateAndCoincidentTriangles) {
    Scene scene = emptyScene();
    addTriangle(scene, {0, 0, 1}, {0, 0, 1}, {0, 0, 1});
    addTriangle(scene, {-1, -1, 1}, {0, 0, 1}, {1, 1, 1});
    addTriangle(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, 1});
    Random random(4);
    std::vector<TracedRay> rays;
    for (int i = 0; i < 2000; ++i) {
        const double s = random.uniform(-1, 1);
        rays.push_back({{0, 0, 0}, Vec3f(normalize(Vec3d{s, i % 2 ? s : 0, 1}))});
    }
    Tracer degenerate(*device, scene);
    for (const TracedHit& hit : degenerate.closest(rays)) EXPECT_FALSE(hit.any() && !std::isfinite(hit.t));

    // Behind them two coincident faces, of opposite orientation, and a needle.
    addTriangle(scene, {-9, -9, 2}, {9, -9, 2}, {0, 9, 2});
    addTriangle(scene, {-9, -9, 2}, {0, 9, 2}, {9, -9, 2});
    addTriangle(scene, {-9, 0, 1.5f}, {9, 1e-6f, 1.5f}, {9, -1e-6f, 1.5f});
    Tracer tracer(*device, scene);
    for (const TracedHit& hit : tracer.closest(rays)) {
        ASSERT_TRUE(hit.any());
        ASSERT_GE(hit.primitive, 3u) << "a triangle without area was hit";
    }
    expectBruteForce("points and lines for triangles, a needle, coincident faces", tracer,
                     randomRays(20000, 3.0, random));
}

/// Rays from inside at vertices and at points of edges: none may escape.
void expectWatertight(const std::string& difficulty, Device& device, const Scene& scene, const Vec3f& centerFloat,
                      double inside, size_t rayCount, Random& random) {
    Tracer tracer(device, scene);
    const Vec3d center(centerFloat);
    const Mesh& mesh = scene.meshes.front();
    std::vector<TracedRay> rays;
    for (size_t i = 0; i < rayCount; ++i) {
        const auto& triangle = mesh.triangles[random.index(uint32_t(mesh.triangles.size()))];
        const uint32_t corner = random.index(3);
        const Vec3f a = mesh.positions[triangle[corner]], b = mesh.positions[triangle[(corner + 1) % 3]];
        const float s = i % 2 ? 0.0f : i % 4 ? 0.5f : float(random.uniform());
        const Vec3f origin(i % 8 < 4 ? center : center + randomDirection(random) * (inside * random.uniform()));
        const Vec3f direction = a + (b - a) * s - origin;
        rays.push_back({origin, i % 3 ? normalize(direction) : direction});
    }
    const auto hits = tracer.closest(rays);
    size_t escapes = 0;
    for (size_t i = 0; i < rays.size(); ++i)
        if (!hits[i].any() && ++escapes <= 3)
            ADD_FAILURE() << "ray " << i << " escapes along " << rays[i].direction.x << " " << rays[i].direction.y
                          << " " << rays[i].direction.z;
    expectWithin({"Intersection", difficulty, "rays at vertices and edges that slip through", 0}, double(escapes),
                 device.info().name);
}

TEST_F(IntersectionTest, ClosedMeshesAreWatertight) {
    Random random(5);
    struct Case {
        uint32_t levels;
        Vec3f center;
        float radius, roughness;
    };
    for (const Case& c : {Case{0, {0, 0, 0}, 1, 0}, Case{2, {0, 0, 0}, 1, 0.3f}, Case{3, {1, 2, 3}, 1, 0.5f},
                          Case{4, {100, -50, 20}, 1, 0.1f}, Case{5, {0, 0, 0}, 1, 0.2f},
                          Case{6, {0.3f, 0, 0}, 1e4f, 0.0f}, Case{4, {1e4f, 1e4f, 1e4f}, 10, 0}}) {
        SCOPED_TRACE(testing::Message() << "levels " << c.levels << ", radius " << c.radius << ", centre "
                                        << c.center.x);
        expectWatertight("closed meshes of up to 81,920 triangles, also far from the origin", *device,
                         closedMesh(c.levels, c.center, c.radius, c.roughness, random), c.center,
                         0.2 * double(c.radius), 100000, random);
    }
}

// Flattened and stretched, so that triangles are needles and rays graze them.
TEST_F(IntersectionTest, NeedleMeshesAreWatertight) {
    Random random(9);
    for (const Vec3f& stretch : {Vec3f{1, 1, 1e-3f}, Vec3f{1e-3f, 1, 1e-3f}, Vec3f{100, 1, 0.01f}}) {
        SCOPED_TRACE(testing::Message() << "stretched by " << stretch.x << ", " << stretch.y << ", " << stretch.z);
        Scene scene = closedMesh(4, {}, 1, 0.2f, random);
        for (Vec3f& p : scene.meshes.front().positions) p = p * stretch;
        const double inside = 0.2 * double(std::min({stretch.x, stretch.y, stretch.z}));
        expectWatertight("closed meshes of needles, grazed", *device, scene, {}, inside, 200000, random);
    }
}

// A box whose faces are cut into a grid of uneven lines: boxes without thickness, edges on their borders.
TEST_F(IntersectionTest, AxisParallelBoxesAreWatertight) {
    Random random(6);
    for (int repetition = 0; repetition < 4; ++repetition) {
        constexpr int lines = 17;
        std::array<float, lines> at{-1};
        for (int i = 1; i < lines; ++i)
            at[size_t(i)] = i + 1 == lines ? 1.0f : at[size_t(i) - 1] + float(random.uniform(0.001, 0.12));
        Scene scene = emptyScene();
        const Vec3f offset(Vec3d{100, -7, 0.01} * double(repetition));
        for (int axis = 0; axis < 3; ++axis)
            for (float side : {-1.0f, 1.0f})
                for (size_t i = 0; i + 1 < lines; ++i)
                    for (size_t j = 0; j + 1 < lines; ++j) {
                        const auto corner = [&](size_t k, size_t l) {
                            Vec3f p;
                            p[axis] = side, p[(axis + 1) % 3] = at[k], p[(axis + 2) % 3] = at[l];
                            return p + offset;
                        };
                        addTriangle(scene, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
                        addTriangle(scene, corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
                    }
        SCOPED_TRACE(repetition);
        expectWatertight("boxes without thickness, edges on their borders", *device, scene,
                         Vec3f{0.1f, 0.2f, 0.3f} + offset, 0.5, 100000, random);
    }
}

// The depth that the BVH asks for is always enough; with less, rays that are cut off must be counted.
TEST_F(IntersectionTest, AStackTooSmallIsCounted) {
    Random random(9);
    const Scene scene = randomSoup(3000, 0, random);
    const auto rays = randomRays(5000, 2.0, random);
    Tracer whole(*device, scene);
    ASSERT_GT(whole.stackDepth(), 2u);
    whole.closest(rays);
    EXPECT_EQ(whole.events(EventKind::StackOverflow), 0u);
    Tracer cut(*device, scene, 1);
    cut.closest(rays);
    EXPECT_GT(cut.events(EventKind::StackOverflow), 0u);
    EXPECT_EQ(cut.events(EventKind::LoopLimit), 0u) << "a traversal that overflows must still end";
}

TEST_F(IntersectionTest, PowersOfTwoScaleExactly) {
    Random random(8);
    const Scene scene = randomSoup(300, 60, random);
    const auto rays = randomRays(5000, 2.0, random);
    Tracer original(*device, scene);
    const auto expected = original.closest(rays);
    for (int k = -10; k <= 10; ++k) {
        const float factor = std::ldexp(1.0f, k);
        Tracer tracer(*device, scaled(scene, factor));
        std::vector<TracedRay> scaledRays = rays;
        for (TracedRay& ray : scaledRays) {
            ray.origin *= factor;
            if (ray.tMax < 1e28f) ray.tMax *= factor;
        }
        const auto hits = tracer.closest(scaledRays);
        size_t different = 0;
        for (size_t i = 0; i < rays.size(); ++i)
            different += hits[i].primitive != expected[i].primitive ||
                         (hits[i].any() && hits[i].t != expected[i].t * factor) || hits[i].b1 != expected[i].b1 ||
                         hits[i].b2 != expected[i].b2;
        SCOPED_TRACE(k);
        expectWithin({"Scale", "rays and scene × 2ᵏ, k from −10 to 10", "hits that differ in any bit", 0},
                     double(different), device->info().name);
    }
}

}  // namespace
}  // namespace antipode
