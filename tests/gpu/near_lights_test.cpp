// The brightest spot under a lamp, against closed forms.
#include "gpu/near_lights.h"

#include <cmath>

#include <gtest/gtest.h>

namespace antipode {
namespace {

Scene floorAndLamp(Vec3f lamp, float intensity = 1) {
    Scene scene;
    Mesh floor;
    floor.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(floor);
    scene.pointLights.push_back({lamp, Vec3f(intensity)});
    return scene;
}

TEST(BrightestSpot, IsBelowTheLamp) {
    EXPECT_NEAR(brightestSpot(floorAndLamp({0.3f, 0.01f, 0.2f}), 0), 1e4, 1e-2);
    EXPECT_NEAR(brightestSpot(floorAndLamp({0.3f, -0.5f, 0.2f}, 3), 0), 12, 1e-5) << "from behind";
}

// Beside the floor: cosθ/d² = h/d³ at its nearest edge, d² = 0.09 + 0.16, or corner, d² = 0.09 + 0.09 + 0.04.
TEST(BrightestSpot, IsTheNearestPointOfWhatIsNotBelow) {
    EXPECT_NEAR(brightestSpot(floorAndLamp({1.4f, 0.3f, 0}), 0), 0.3 / 0.125, 1e-5);
    EXPECT_NEAR(brightestSpot(floorAndLamp({1.3f, 0.2f, -1.3f}), 0), 0.2 / std::pow(0.22, 1.5), 1e-5);
}

TEST(BrightestSpot, ALampInThePlaneLightsNothingOfIt) {
    EXPECT_EQ(brightestSpot(floorAndLamp({0.5f, 0, 0.5f}), 0), 0);
    EXPECT_EQ(brightestSpot(floorAndLamp({0.5f, 0, 0.5f}), 7), 7);
}

TEST(BrightestSpot, SeesSpheresAndSpots) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, 0});
    scene.spotLights.push_back({});
    scene.spotLights.back().position = {0, 1.1f, 0};
    scene.spotLights.back().intensity = Vec3f{1, 2, 1};
    EXPECT_NEAR(brightestSpot(scene, 0), 200, 1e-3);
    scene.spotLights.back().position = {0, 0.8f, 0};
    EXPECT_NEAR(brightestSpot(scene, 0), 50, 1e-4) << "from within";
}

}  // namespace
}  // namespace antipode
