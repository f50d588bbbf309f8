// r_1 follows what the camera sees.
#include <cmath>

#include <gtest/gtest.h>

#include "renderengine/engine.h"
#include "tests/gpu/pilot_scenes.h"

using namespace antipode;
using namespace antipode::test;

namespace {

RenderSettings sized(uint32_t width, uint32_t height) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    return settings;
}

}  // namespace

TEST(InitialRadius, IsTheWidthOfAPixel) {
    const Scene scene = wall();
    const double height = 5 * 2 * std::tan(0.5 * double(scene.camera.verticalFov));
    EXPECT_NEAR(initialRadius(scene, sized(900, 600)), height / 600, 1e-12);
    EXPECT_NEAR(initialRadius(scene, sized(64, 64)), height / 256, 1e-12) << "a small image is not blurred more";
    RenderSettings settings = sized(900, 600);
    settings.radiusFactor = 3;
    EXPECT_NEAR(initialRadius(scene, settings), 3 * height / 600, 1e-12);
    settings.initialRadius = 0.125;
    EXPECT_EQ(initialRadius(scene, settings), 0.125);
}

TEST(InitialRadius, AFloorToTheHorizonIsASmallFloor) {
    const double small = initialRadius(ballOnFloor(3), sized(240, 180));
    for (const float halfSide : {30.0f, 1000.0f, 1e5f})
        EXPECT_NEAR(initialRadius(ballOnFloor(halfSide), sized(240, 180)) / small, 1, 0.02) << halfSide;
}

TEST(InitialRadius, ANearThingIsNotEverything) {
    Scene scene = wall();
    const double alone = initialRadius(scene, sized(300, 300));
    // A leaf before the lens, a fifth of the picture.
    scene.meshes.push_back(square({0, 0, 4.9f}, {0.016f, 0, 0}, {0, 0.016f, 0}, 0));
    EXPECT_NEAR(initialRadius(scene, sized(300, 300)), alone, 1e-12);
}

TEST(InitialRadius, ScalesToTheBit) {
    const double one = initialRadius(ballOnFloor(3), sized(300, 300));
    for (const int exponent : {-20, 20}) {
        Scene scene = ballOnFloor(3);
        const float f = std::ldexp(1.0f, exponent);
        for (Vec3f& p : scene.meshes[0].positions) p *= f;
        scene.spheres[0].center *= f, scene.spheres[0].radius *= f, scene.camera.position *= f;
        EXPECT_EQ(initialRadius(scene, sized(300, 300)), std::ldexp(one, exponent)) << exponent;
    }
}

TEST(InitialRadius, FollowsTheBoundsWhereNothingMergesInSight) {
    Scene scene = wall();
    scene.materials[0] = lambert(0);
    const double radius = 10 * std::sqrt(2.0), tangent = 2 * std::tan(0.5 * double(scene.camera.verticalFov));
    EXPECT_NEAR(initialRadius(scene, sized(100, 100)), radius / 200, 1e-6);
    EXPECT_NEAR(initialRadius(scene, sized(1000, 1000)), radius * tangent / 1000, 1e-6);
    // A technique without merges asks for no pilot.
    RenderSettings settings = sized(1000, 1000);
    settings.technique = "pt";
    EXPECT_NEAR(initialRadius(wall(), settings), radius * tangent / 1000, 1e-6);
}
