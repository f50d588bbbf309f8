// Brute-force intersection of the reference: distances, sides, rays that start on what they must not hit again.
#include "support/reference/geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderengine/error.h"
#include "support/random.h"

namespace antipode::reference {
namespace {

Scene triangleAndSphere() {
    Scene scene;
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.material = 3;
    scene.meshes.push_back(mesh);
    scene.spheres.push_back({{0, 0, 5}, 2, 4});
    return scene;
}

TEST(ReferenceGeometry, NearestHitAndItsFrontNormal) {
    const Geometry geometry(triangleAndSphere());
    const auto triangle = geometry.intersect({{0.2, 0.2, 1}, {0, 0, -1}});
    ASSERT_TRUE(triangle);
    EXPECT_DOUBLE_EQ(triangle->distance, 1);
    EXPECT_EQ(triangle->normal, Vec3d(0, 0, 1));
    EXPECT_EQ(triangle->material, 3u);
    const auto sphere = geometry.intersect({{0, 0, 1}, {0, 0, 1}});
    ASSERT_TRUE(sphere);
    EXPECT_DOUBLE_EQ(sphere->distance, 2);
    EXPECT_EQ(sphere->normal, Vec3d(0, 0, -1));
    EXPECT_EQ(sphere->material, 4u);
    EXPECT_FALSE(geometry.intersect({{0.7, 0.7, 1}, {0, 0, -1}}));
}

/// 1000 rays from every hit, at coordinates up to 1e8: none hits again where it starts, rays into the sphere leave it.
TEST(ReferenceGeometry, NoSelfIntersection) {
    Random random(31);
    for (const float scale : {1e-8f, 1.0f, 1e8f}) {
        Scene scene;
        scene.spheres.push_back({{3 * scale, -scale, 2 * scale}, scale, 0});
        const Geometry geometry(scene);
        const Vec3d center = geometry.spheres()[0].center;
        for (int i = 0; i < 1000; ++i) {
            const double z = random.uniform(-1, 1), phi = random.uniform(0, 6.28), r = std::sqrt(1 - z * z);
            const Vec3d n{r * std::cos(phi), r * std::sin(phi), z};
            const Vec3d start = center + n * double(scale);
            const Vec3d w = Frame(n).toWorld(normalize(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), 0.1}));
            EXPECT_FALSE(geometry.intersect({start, w, 0}));
            const auto inside = geometry.intersect({start, -w, 0});
            ASSERT_TRUE(inside);
            EXPECT_NEAR(length(inside->position - center) / scale, 1, 1e-12);
        }
    }
}

TEST(ReferenceGeometry, OcclusionEndsAtTheTarget) {
    const Geometry geometry(triangleAndSphere());
    const Ray up{{0.1, 0.1, -1}, {0, 0, 1}};
    EXPECT_FALSE(geometry.occluded(up, 0.5));
    EXPECT_TRUE(geometry.occluded(up, 1.5));
    EXPECT_FALSE(geometry.occluded(up, 1, 0));
    const Ray towardsSphere{{0, 0, 1}, {0, 0, 1}};
    EXPECT_FALSE(geometry.occluded(towardsSphere, 2, 1)) << "near side of the target sphere";
    EXPECT_TRUE(geometry.occluded(towardsSphere, 6, 1)) << "far side of the target sphere";
}

TEST(ReferenceGeometry, FrameIsOrthonormalEverywhere) {
    Random random(32);
    for (int i = 0; i < 1000; ++i) {
        const Vec3d n = i == 0 ? Vec3d(0, 0, -1)
                               : normalize(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
        const Frame f(n);
        EXPECT_NEAR(dot(cross(f.tangent, f.bitangent), f.normal), 1, 1e-12);
        EXPECT_NEAR(length(f.tangent), 1, 1e-12);
        EXPECT_NEAR(dot(f.tangent, f.normal), 0, 1e-12);
    }
}

TEST(ReferenceGeometry, RefusesShadingNormals) {
    Scene scene = triangleAndSphere();
    scene.meshes[0].normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    EXPECT_THROW(Geometry{scene}, Error);
}

}  // namespace
}  // namespace antipode::reference
