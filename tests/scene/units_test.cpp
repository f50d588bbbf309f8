#include "scene/units.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderengine/error.h"
#include "tests/scene/box_scene.h"

using namespace antipode;

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
