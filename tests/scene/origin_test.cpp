#include "scene/origin.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/scene/box_scene.h"

using namespace antipode;

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
