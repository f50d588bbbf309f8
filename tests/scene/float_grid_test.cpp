#include "scene/float_grid.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "renderengine/error.h"

using namespace antipode;

namespace {

/// A box of this half size about a centre, seen from its front.
Scene boxAt(const Vec3f& center, float halfSize) {
    Scene scene;
    Mesh mesh;
    mesh.name = "box";
    for (const float x : {-1.f, 1.f})
        for (const float y : {-1.f, 1.f})
            for (const float z : {-1.f, 1.f}) mesh.positions.push_back(center + Vec3f(x, y, z) * halfSize);
    mesh.triangles = {{0, 1, 2}, {5, 6, 7}};
    scene.meshes.push_back(mesh);
    scene.camera.position = center + Vec3f(0, 0, 3 * halfSize);
    return scene;
}

}  // namespace

TEST(RemoteCenter, IsZeroForScenesAboutTheOrigin) {
    EXPECT_EQ(remoteCenter(boxAt({0, 0, 0}, 1)), Vec3f());
    EXPECT_EQ(remoteCenter(boxAt({3, -3, 3}, 1)), Vec3f());
}

TEST(RemoteCenter, LooksAtEachAxisAlone) {
    EXPECT_EQ(remoteCenter(boxAt({1000, 0.5f, -2000}, 1)), Vec3f(1000, 0, -2000));
}

TEST(RemoteCenter, MovesSurfacesWithoutRounding) {
    std::mt19937 random(7);
    for (int round = 0; round < 1000; ++round) {
        std::uniform_real_distribution<float> exponent(-10, 20), unit(-1, 1);
        const float size = std::exp2(exponent(random)), distance = size * std::exp2(std::abs(exponent(random)));
        Scene scene = boxAt(Vec3f(unit(random), unit(random), unit(random)) * distance, size);
        for (Vec3f& p : scene.meshes[0].positions) p += Vec3f(unit(random), unit(random), unit(random)) * size;
        const Vec3f origin = remoteCenter(scene);
        const Scene moved = movedToOrigin(scene, origin);
        for (size_t i = 0; i < scene.meshes[0].positions.size(); ++i) {
            const Vec3d exact = Vec3d(scene.meshes[0].positions[i]) - Vec3d(origin);
            ASSERT_EQ(Vec3d(moved.meshes[0].positions[i]), exact) << "round " << round;
        }
    }
}

TEST(MovedToOrigin, TakesEverythingAlong) {
    Scene scene = boxAt({64, 0, 0}, 1);
    scene.spheres.push_back({{65, 1, 2}, 0.5f, 0});
    scene.pointLights.push_back({{66, 2, 3}, Vec3f(1)});
    scene.spotLights.push_back({{67, 3, 4}, {0, 0, 1}, Vec3f(1)});
    const Scene moved = movedToOrigin(scene, {64, 0, 0});
    EXPECT_EQ(moved.spheres[0].center, Vec3f(1, 1, 2));
    EXPECT_EQ(moved.pointLights[0].position, Vec3f(2, 2, 3));
    EXPECT_EQ(moved.spotLights[0].position, Vec3f(3, 3, 4));
    EXPECT_EQ(moved.spotLights[0].direction, Vec3f(0, 0, 1));
    EXPECT_EQ(moved.camera.position, Vec3f(0, 0, 3));
}

TEST(UnitExponent, IsZeroForScenesOfCommonSizes) {
    for (const float size : {1e-4f, 0.01f, 1.f, 1000.f, 3e4f})
        EXPECT_EQ(unitExponent(boxAt({0, 0, 0}, size)), 0) << size;
}

TEST(UnitExponent, BringsTheRadiusBetweenOneAndTwo) {
    for (const float size : {1e-29f, 1e-12f, 1e-6f, 1e6f, 1e12f, 1e29f}) {
        const Scene scene = boxAt({0, 0, 0}, size);
        const double radius = std::ldexp(boundingRadius(scene), unitExponent(scene));
        EXPECT_GE(radius, 1) << size;
        EXPECT_LT(radius, 2) << size;
    }
}

TEST(InUnits, ScalesLengthsAndKeepsIrradiances) {
    Scene scene = boxAt({0, 0, 0}, 1);
    scene.camera.lensRadius = 0.5f;
    scene.camera.focusDistance = 3;
    scene.spheres.push_back({{1, -2, 3}, 0.5f, 0});
    scene.pointLights.push_back({{1, 2, 3}, Vec3f(6)});
    scene.spotLights.push_back({{3, 2, 1}, {0, 0, 1}, Vec3f(5)});
    scene.directionalLights.push_back({{0, 0, 1}, Vec3f(4)});
    const Scene scaled = inUnits(scene, -3);
    EXPECT_EQ(scaled.meshes[0].positions[0], scene.meshes[0].positions[0] * 0.125f);
    EXPECT_EQ(scaled.spheres[0].center, Vec3f(0.125f, -0.25f, 0.375f));
    EXPECT_EQ(scaled.spheres[0].radius, 0.0625f);
    EXPECT_EQ(scaled.pointLights[0].position, Vec3f(0.125f, 0.25f, 0.375f));
    EXPECT_EQ(scaled.pointLights[0].intensity, Vec3f(6.f / 64));
    EXPECT_EQ(scaled.spotLights[0].position, Vec3f(0.375f, 0.25f, 0.125f));
    EXPECT_EQ(scaled.spotLights[0].intensity, Vec3f(5.f / 64));
    EXPECT_EQ(scaled.spotLights[0].direction, Vec3f(0, 0, 1));
    EXPECT_EQ(scaled.directionalLights[0].irradiance, Vec3f(4));
    EXPECT_EQ(scaled.camera.position, scene.camera.position * 0.125f);
    EXPECT_EQ(scaled.camera.lensRadius, 0.0625f);
    EXPECT_EQ(scaled.camera.focusDistance, 0.375f);
}

TEST(InUnits, RefusesWhatLeavesTheRangeOfFloats) {
    Scene bright = boxAt({0, 0, 0}, 1);
    bright.pointLights.push_back({{0, 0, 0}, Vec3f(1)});
    EXPECT_NO_THROW(inUnits(bright, 60));
    EXPECT_THROW(inUnits(bright, 66), Error) << "the intensity overflows";
    EXPECT_THROW(inUnits(bright, -66), Error) << "the intensity is no normal number";
    Scene far = boxAt({0, 0, 0}, 1);
    far.camera.position = {1e20f, 0, 0};
    EXPECT_THROW(inUnits(far, 70), Error) << "the camera's place overflows";
}

TEST(PrecisionNotices, SayNothingWhereFloatsSuffice) {
    EXPECT_TRUE(precisionNotices(boxAt({0, 0, 0}, 1)).empty());
    EXPECT_TRUE(precisionNotices(boxAt({0, 0, 0}, 1e-6f)).empty());
    EXPECT_TRUE(precisionNotices(boxAt({100, 0, 0}, 1)).empty());
}

TEST(PrecisionNotices, TellHowFarOffADistantSceneIs) {
    // At 10^5 floats are 2^-7 apart: positions err by up to 2^-8 = .0039. A pixel of the 512 that show about 2.5 units
    // of height at a distance of 3 is .0049 wide.
    const auto notices = precisionNotices(boxAt({1e5f, 0, 0}, 1));
    ASSERT_EQ(notices.size(), 2u);
    EXPECT_NE(notices[0].find("0.0039 units"), std::string::npos) << notices[0];
    EXPECT_NE(notices[0].find("0.8 pixels"), std::string::npos) << notices[0];
}

TEST(PrecisionNotices, NameTheSmallThingFarFromTheOrigin) {
    Scene scene = boxAt({0, 0, 0}, 1e4f);
    scene.spheres.push_back({{9000, 0, 0}, 0.001f, 0});
    const auto notices = precisionNotices(scene);
    ASSERT_EQ(notices.size(), 2u);  // the box's triangles are huge beside it, too
    EXPECT_NE(notices[0].find("sphere #0"), std::string::npos) << notices[0];
}

TEST(PrecisionNotices, NameTheSmallestObjectBesideHugeTriangles) {
    Scene scene = boxAt({0, 0, 0}, 1000);
    scene.spheres.push_back({{0, 0, 0.5f}, 0.02f, 0});
    EXPECT_EQ(precisionNotices(scene).size(), 0u);
    scene.spheres.push_back({{1, 0, 0.5f}, 0.009f, 0});
    const auto notices = precisionNotices(scene);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("sphere #1"), std::string::npos) << notices[0];
    EXPECT_NE(notices[0].find("0.00017 units"), std::string::npos) << notices[0];
}
