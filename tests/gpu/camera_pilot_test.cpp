#include "gpu/camera_pilot.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/gpu/pilot_scenes.h"

using namespace antipode;
using namespace antipode::test;

namespace {

std::vector<double> heightsOf(const Scene& scene) {
    std::vector<double> heights = tracePilotPaths(scene, 1.5).pictureHeights;
    std::sort(heights.begin(), heights.end());
    return heights;
}

/// What the field of view covers at this depth.
double heightAt(const Scene& scene, double depth) {
    return depth * 2 * std::tan(0.5 * double(scene.camera.verticalFov));
}

/// Expects every path to end, all at this depth.
void expectAllAt(const Scene& scene, double depth, double tolerance) {
    const PilotPaths seen = tracePilotPaths(scene, 1.5);
    EXPECT_EQ(seen.pictureHeights.size(), seen.paths);
    for (const double height : seen.pictureHeights)
        ASSERT_NEAR(height, heightAt(scene, depth), tolerance * heightAt(scene, depth));
}

}  // namespace

TEST(CameraPilot, AWallIsSeenAtItsDepth) {
    Scene scene = wall();
    expectAllAt(scene, 5, 1e-12);
    scene.meshes.clear();
    scene.spheres = {{{0, 0, -1000}, 1000, 0}};
    expectAllAt(scene, 5, 5e-3);
}

TEST(CameraPilot, AFlatMirrorUnfolds) {
    // The wall stands behind the camera at z = 7 and is seen in a mirror at z = 0: 5 there and 7 back.
    Scene scene = wall();
    scene.materials.push_back(specular(MaterialKind::Mirror));
    scene.meshes[0].material = 1;
    scene.meshes.push_back(square({0, 0, 7}, {100, 0, 0}, {0, 100, 0}, 0));
    expectAllAt(scene, 12, 1e-12);
}

TEST(CameraPilot, GlassIsLookedThrough) {
    Scene scene = wall();
    scene.materials.push_back(specular(MaterialKind::Dielectric));
    scene.meshes.push_back(square({0, 0, 2.2f}, {10, 0, 0}, {0, 10, 0}, 1));   // front towards the camera
    scene.meshes.push_back(square({0, 0, 2.0f}, {10, 0, 0}, {0, -10, 0}, 1));  // and away from it
    // The path within the pane is a little steeper.
    expectAllAt(scene, 5, 5e-3);
}

TEST(CameraPilot, ATrappedPathAndWhatNeverMergesMeetNothing) {
    Scene scene = wall();
    scene.materials[0] = lambert(0);
    EXPECT_TRUE(heightsOf(scene).empty()) << "a black wall";
    scene.materials[0] = specular(MaterialKind::Mirror);
    scene.meshes.push_back(square({0, 0, 10}, {1000, 0, 0}, {0, 1000, 0}, 0));
    EXPECT_TRUE(heightsOf(scene).empty()) << "between two mirrors";
    scene.meshes.clear();
    scene.materials[0] = specular(MaterialKind::Dielectric);
    scene.spheres = {{{0, 0, 0}, 1, 0}};
    EXPECT_TRUE(heightsOf(scene).empty()) << "a glass ball alone";
}

TEST(CameraPilot, WhatIsOutOfSightChangesNothing) {
    const Scene scene = ballOnFloor(3);
    const std::vector<double> before = heightsOf(scene);
    Scene more = scene;
    more.meshes.push_back(square({0, 0, 5000}, {4000, 0, 0}, {0, 4000, 0}, 0));  // behind the camera
    more.meshes.push_back(square({0, -2, 0}, {2, 0, 0}, {0, 0, 2}, 0));          // under the floor
    more.spheres.push_back({{1e6f, 0, 1e6f}, 1000, 0});
    EXPECT_EQ(heightsOf(more), before);
    ASSERT_GT(before.size(), 500u);
}

TEST(CameraPilot, ScalesToTheBit) {
    Scene scene = ballOnFloor(3);
    scene.materials.push_back(specular(MaterialKind::Dielectric));
    scene.materials.push_back(specular(MaterialKind::Mirror));
    scene.spheres.push_back({{1.5f, 0, 1.5f}, 0.4f, 1});
    scene.spheres.push_back({{-1.5f, 0, 1.5f}, 0.4f, 2});
    const std::vector<double> before = heightsOf(scene);
    for (const int exponent : {-60, -20, -1, 1, 20, 55}) {
        const float f = std::ldexp(1.0f, exponent);
        Scene scaled = scene;
        for (Mesh& mesh : scaled.meshes)
            for (Vec3f& p : mesh.positions) p *= f;
        for (Sphere& s : scaled.spheres) s.center *= f, s.radius *= f;
        scaled.camera.position *= f;
        std::vector<double> heights = heightsOf(scaled);
        for (double& height : heights) height = std::ldexp(height, -exponent);
        EXPECT_EQ(heights, before) << "2^" << exponent;
    }
}
