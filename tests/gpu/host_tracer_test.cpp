// The BVH's closest hits against a walk through all surfaces.
#include "gpu/host_tracer.h"

#include <cmath>
#include <deque>
#include <random>

#include <gtest/gtest.h>

#include "tests/gpu/pilot_scenes.h"

using namespace antipode;
using namespace antipode::test;

namespace {

/// The scene with one of its surfaces alone, meshes first.
Scene alone(const Scene& scene, uint32_t surface) {
    Scene one;
    one.materials = scene.materials;
    if (surface < scene.meshes.size())
        one.meshes = {scene.meshes[surface]};
    else
        one.spheres = {scene.spheres[surface - scene.meshes.size()]};
    return one;
}

}  // namespace

TEST(HostTracer, FindsTheNearestOfAll) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    const auto point = [&] { return Vec3f(coordinate(random), coordinate(random), coordinate(random)); };
    Scene scene;
    scene.materials = {lambert(0.5f)};
    for (int i = 0; i < 60; ++i) {
        Mesh mesh;
        const Vec3f center = point();
        mesh.positions = {center + point() * 0.3f, center + point() * 0.3f, center + point() * 0.3f};
        mesh.triangles = {{0, 1, 2}};
        scene.meshes.push_back(mesh);
        if (i % 3 == 0) scene.spheres.push_back({point(), 0.1f, 0});
    }
    const HostTracer tracer(scene);
    std::deque<Scene> scenes;
    std::deque<HostTracer> each;
    for (uint32_t i = 0; i < scene.meshes.size() + scene.spheres.size(); ++i)
        each.emplace_back(scenes.emplace_back(alone(scene, i)));
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3d origin(point() * 2.0f), direction = normalize(Vec3d(point()) - origin);
        double nearest = std::numeric_limits<double>::infinity();
        for (const HostTracer& one : each)
            if (const auto hit = one.closest(origin, direction, {})) nearest = std::min(nearest, hit->distance);
        const auto hit = tracer.closest(origin, direction, {});
        ASSERT_EQ(hit.has_value(), std::isfinite(nearest)) << i;
        if (!hit) continue;
        EXPECT_EQ(hit->distance, nearest) << i;
        ++hits;
    }
    EXPECT_GT(hits, 50);
}

TEST(HostTracer, ARayWithinABoxsFaceAndAlongAnAxisHits) {
    Scene scene;
    scene.materials = {lambert(0.5f)};
    scene.meshes = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0)};
    const HostTracer tracer(scene);
    for (const Vec3d& origin : {Vec3d(0, 0, 1), Vec3d(0.5, -0.25, 1), Vec3d(1, 0.5, 1), Vec3d(-1, -1, 1)}) {
        const auto hit = tracer.closest(origin, {0, 0, -1}, {});
        ASSERT_TRUE(hit) << origin.x << " " << origin.y;
        EXPECT_EQ(hit->distance, 1);
        EXPECT_EQ(hit->normal.z, 1);
    }
}

TEST(HostTracer, OfEquallyNearSurfacesTheFirstIsMet) {
    Scene scene;
    scene.materials = {lambert(0.5f), lambert(0.25f)};
    scene.meshes = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1), square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0)};
    EXPECT_EQ(HostTracer(scene).closest({0.3, 0.2, 1}, {0, 0, -1}, {})->material, 1u);
}

TEST(HostTracer, ASphereThatIsLeftInwardsIsMetOnItsOtherSide) {
    Scene scene;
    scene.materials = {lambert(0.5f)};
    scene.spheres = {{{0, 0, 0}, 1, 0}};
    const HostTracer tracer(scene);
    const auto in = tracer.closest({0, 0, 3}, {0, 0, -1}, {});
    ASSERT_TRUE(in);
    EXPECT_EQ(in->distance, 2);
    const auto out = tracer.closest({0, 0, 1}, {0, 0, -1}, in->surface);
    ASSERT_TRUE(out);
    EXPECT_EQ(out->distance, 2);
    EXPECT_FALSE(tracer.closest({0, 0, -1}, {0, 0, -1}, in->surface));
}
