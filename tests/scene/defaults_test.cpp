// What files without light or camera are given.
#include "scene/defaults.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/lamp_units.h"
#include "scene/light_pilot.h"
#include "scene/readable_names.h"

namespace antipode {
namespace {

Mesh quad(const Vec3f& corner, const Vec3f& u, const Vec3f& v, uint32_t material) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    return mesh;
}

/// A floor of 2×2 under a lamp of this side that faces it from above, seen from the front.
Scene floorUnderLamp(float side, float radiance, float lampFacing = 1) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].emission = Vec3f(radiance);
    scene.meshes.push_back(quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0));
    scene.meshes.push_back(quad({-side / 2, 1, -side / 2}, {side, 0, 0}, {0, 0, side * lampFacing}, 1));
    scene.camera.position = {0, 0.5f, 5};
    return scene;
}

TEST(LightPilot, LampsThatLightTheFloorAreEnough) {
    EXPECT_TRUE(lightsTheView(floorUnderLamp(0.5f, 5)));
    EXPECT_TRUE(lightsTheView(floorUnderLamp(0.5f, 0.001f))) << "dim, but as bright beside the lamp";
}

TEST(LightPilot, SmallOrAvertedLampsAreNot) {
    EXPECT_FALSE(lightsTheView(floorUnderLamp(0.02f, 1)));
    EXPECT_FALSE(lightsTheView(floorUnderLamp(0.5f, 5, -1))) << "it shines upwards";
}

TEST(LightPilot, PointsAndSunsAreEnough) {
    Scene scene = floorUnderLamp(0.02f, 1);
    scene.pointLights.push_back({{0, 1, 0}, Vec3f(1e-3f)});
    EXPECT_TRUE(lightsTheView(scene));
}

/// A square of 2×2 before the camera.
Scene card(float reflectance, float radiance) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].baseColor = Vec3f(reflectance);
    scene.materials[0].emission = Vec3f(radiance);
    scene.meshes.push_back(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0));
    scene.camera.position = {0, 0, 5};
    return scene;
}

/// Two texels beside each other, sRGB and alpha.
Texture twoTexels(std::array<uint8_t, 4> left, std::array<uint8_t, 4> right) {
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.rgba.assign(left.begin(), left.end());
    texture.rgba.insert(texture.rgba.end(), right.begin(), right.end());
    return texture;
}

TEST(LightPilot, UnlitModelsShowThemselves) {
    EXPECT_TRUE(lightsTheView(card(0, 1)));
    EXPECT_TRUE(lightsTheView(card(0.8f, 1)));
}

TEST(LightPilot, GlowOnWhatHasAColourIsNoLight) { EXPECT_FALSE(lightsTheView(card(0.6f, 0.1f))); }

TEST(LightPilot, FewerThanAQuarterLitIsNotEnough) {
    // Of the floor's middle, a twentieth of its area, this lamp makes .01 of its own radiance.
    EXPECT_FALSE(lightsTheView(floorUnderLamp(0.22f, 1)));
}

TEST(LightPilot, TexturesSayWhatEmits) {
    Scene scene = card(0.8f, 1);
    scene.meshes[0].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.textures = {twoTexels({255, 255, 255, 255}, {255, 255, 255, 255})};
    scene.materials[0].emissionTexture = 0;
    EXPECT_TRUE(lightsTheView(scene));
    scene.textures = {twoTexels({0, 0, 0, 255}, {255, 255, 255, 255})};
    EXPECT_FALSE(lightsTheView(scene)) << "half of the card is in the dark";
}

TEST(LightPilot, HolesNeitherEmitNorAreSeen) {
    Scene scene = card(0.8f, 1);
    scene.materials[0].coverage = 0.0f;
    EXPECT_FALSE(lightsTheView(scene));

    scene = card(0.8f, 1);
    scene.meshes[0].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.textures = {twoTexels({0, 0, 0, 0}, {255, 255, 255, 255})};
    scene.materials[0].emissionTexture = scene.materials[0].baseColorTexture = 0;
    EXPECT_FALSE(lightsTheView(scene));
    scene.materials[0].alphaCutoff = 0.5f;
    EXPECT_TRUE(lightsTheView(scene)) << "its dark half is cut away";
}

TEST(DefaultLight, StudiosHaveAGroundUnlessTheCameraIsBelow) {
    for (Studio studio : {Studio::Soft, Studio::Sun}) {
        Scene scene = floorUnderLamp(0.02f, 0);
        addDefaultLight(scene, studio);
        EXPECT_TRUE(hasLight(scene));
        ASSERT_EQ(scene.meshes.size(), 3u);
        EXPECT_LT(scene.meshes[2].positions[0].y, 0);
        EXPECT_NO_THROW(validate(scene));
        Scene below = floorUnderLamp(0.02f, 0);
        below.camera.position.y = -1;
        addDefaultLight(below, studio);
        EXPECT_EQ(below.meshes.size(), 2u);
    }
    Scene scene = floorUnderLamp(0.02f, 0);
    addDefaultLight(scene, Studio::None);
    EXPECT_EQ(scene.environment->radiance, Vec3f(1));
    EXPECT_EQ(scene.meshes.size(), 2u);
}

/// Walls around the origin, fronts inside or outside.
Scene box(bool inward) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].emission = Vec3f(5);
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 2 : -2, i & 2 ? 1 : -1, i & 4 ? 2 : -2);
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    if (inward)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    scene.meshes.push_back(mesh);
    scene.meshes.push_back(quad({-0.2f, 0.9f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}, 1));
    return scene;
}

bool isInside(const Vec3f& p) { return std::abs(p.x) < 2 && std::abs(p.y) < 1 && std::abs(p.z) < 2; }

TEST(DefaultCamera, StandsInsideRoomsAndOutsideBodies) {
    Scene room = box(true), body = box(false);
    addDefaultCamera(room);
    addDefaultCamera(body);
    EXPECT_TRUE(isInside(room.camera.position));
    EXPECT_FALSE(isInside(body.camera.position));
    EXPECT_NO_THROW(validate(room));
}

TEST(DefaultCamera, OutliersDoNotCount) {
    Scene scene;
    scene.materials.resize(1);
    Mesh sheet;
    for (int i = 0; i < 400; ++i) {
        const float x = float(i % 20) / 20, y = float(i / 20) / 20;
        const auto at = uint32_t(sheet.positions.size());
        sheet.positions.insert(sheet.positions.end(), {{x, y, 0}, {x + 0.05f, y, 0}, {x, y + 0.05f, 0}});
        sheet.triangles.push_back({at, at + 1, at + 2});
    }
    scene.meshes.push_back(sheet);
    addDefaultCamera(scene);
    const float near = scene.camera.focusDistance;
    scene.meshes.push_back(quad({1000, 1000, 1000}, {1, 0, 0}, {0, 1, 0}, 0));
    addDefaultCamera(scene);
    EXPECT_EQ(scene.camera.focusDistance, near);
}

TEST(LampUnits, BlendersStandardLampsArePhotometric) {
    const std::string blender = "Khronos glTF Blender I/O v4.2.57";
    const auto factor = [&](LampUnits units, const std::string& generator, float sun, float point) {
        Scene lamps;
        if (sun > 0) lamps.directionalLights.push_back({{0, 0, -1}, Vec3f(sun)});
        if (point > 0) lamps.pointLights.push_back({{}, Vec3f(point)});
        return wattsPerLumen(units, generator, lamps);
    };
    EXPECT_EQ(factor(LampUnits::ByGenerator, blender, 3 * 683.0f, 0), 1 / 683.0f);
    EXPECT_EQ(factor(LampUnits::ByGenerator, blender, 0, 50 * 683.0f / 12.566f), 1 / 683.0f);
    EXPECT_EQ(factor(LampUnits::ByGenerator, blender, 3.14159f, 0), 1) << "Unitless";
    EXPECT_EQ(factor(LampUnits::ByGenerator, blender, 0, 1000 / 12.566f), 1) << "Unitless";
    EXPECT_EQ(factor(LampUnits::ByGenerator, "by hand", 2049, 0), 1);
    EXPECT_EQ(factor(LampUnits::Photometric, "by hand", 3, 0), 1 / 683.0f);
    EXPECT_EQ(factor(LampUnits::Radiometric, blender, 2049, 0), 1);
}

TEST(FilesCamera, SeesSurfacesUnlessTheyAreADotOrElsewhere) {
    Scene scene = card(0.8f, 0);
    EXPECT_TRUE(seesSurfaces(scene));
    scene.camera.position.z = 200;
    EXPECT_FALSE(seesSurfaces(scene)) << "a dot";
    scene.camera.position = {0.9f, 0, 0.1f};
    EXPECT_TRUE(seesSurfaces(scene)) << "too near to see a vertex";
    scene.camera.position.z = -5;
    EXPECT_FALSE(seesSurfaces(scene)) << "behind it";
    scene.camera = {};
    scene.camera.position = {0, 0, 200};
    scene.camera.orthographicHeight = 4;
    EXPECT_TRUE(seesSurfaces(scene)) << "in a parallel projection distance does not count";
}

TEST(FilesCamera, BlendersFirstIsLeftOverWhereItMissesTheModel) {
    Scene scene = card(0.8f, 0);
    scene.camera.position = {7.358891f, 4.958309f, 6.925791f};
    scene.camera.forward = {-0.6515582f, -0.4452454f, -0.6141704f};
    EXPECT_FALSE(isLeftOver(scene)) << "it sees all of it";
    for (Vec3f& p : scene.meshes[0].positions) p = p * 30.0f;
    EXPECT_TRUE(isLeftOver(scene));
    scene.camera.position = scene.camera.position * 0.01f;
    EXPECT_TRUE(isLeftOver(scene)) << "in centimetres";
    scene.camera.position.x *= 1.1f;
    EXPECT_FALSE(isLeftOver(scene)) << "somebody has moved it";
}

TEST(Notices, SayTheSameOfSeveralMaterialsOnce) {
    std::vector<std::string> notices = {"Material 'a' glows.", "Mesh 'm' is flat.",      "Material 'b' glows.",
                                        "Material 'a' glows.", "Material 'c': it hums.", "Material 'd' glows."};
    foldNotices(notices);
    EXPECT_EQ(notices, (std::vector<std::string>{"Material 'a' glows. So it is with 2 more materials.",
                                                 "Mesh 'm' is flat.", "Material 'c': it hums."}));
}

}  // namespace
}  // namespace antipode
