// What a scene calls for: one crafted scene for each effect, and every effect that can be taken away.
#include "renderengine/scene_effects.h"

#include <algorithm>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

using Keys = std::set<std::string>;

Keys present(const Scene& scene) {
    Keys keys;
    for (const SceneEffect& effect : sceneEffects(scene))
        if (effect.present) keys.insert(effect.key);
    return keys;
}

/// A matte floor under a lamp.
Scene plainScene() {
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 2, addLambert(scene, Vec3f(0.5f)));
    scene.meshes[0].uvs.clear();
    scene.spheres = {{{0, 9, 0}, 0.5f, addLamp(scene, Vec3f(1.0f))}};
    scene.camera = lookAt({0, 3, 3}, {0, 0, 0}, {0, 1, 0}, 0.8);
    return scene;
}

Material& floorOf(Scene& scene) { return scene.materials[0]; }

uint32_t addTexture(Scene& scene) {
    scene.textures.push_back({"t", 1, 1, {128, 128, 255, 128}});
    scene.meshes[0].uvs.assign(scene.meshes[0].positions.size(), {0, 0});
    return uint32_t(scene.textures.size() - 1);
}

TEST(SceneEffects, EachIsFoundWhereItIs) {
    const Keys plain = present(plainScene());
    EXPECT_EQ(plain, (Keys{"triangles", "spheres", "matte", "glowing_spheres"}));
    const auto adds = [&](const char* what, const std::function<void(Scene&)>& change, Keys added) {
        SCOPED_TRACE(what);
        Scene scene = plainScene();
        change(scene);
        added.insert(plain.begin(), plain.end());
        EXPECT_EQ(present(scene), added);
    };
    const auto ball = [](MaterialKind kind, float roughness) {
        return [=](Scene& s) {
            s.spheres.push_back({{0, 1, 0}, 0.5f, addMaterial(s, kind, Vec3f(0.4f), roughness)});
            s.materials.back().specular = Vec3f(0.5f);
        };
    };
    using enum MaterialKind;
    adds("normals", [](Scene& s) { s.meshes[0].normals.assign(4, {0, 1, 0}); }, {"attributes"});
    adds("Phong", ball(Phong, 1), {"phong"});
    adds("mirror", ball(Mirror, 1), {"mirrors"});
    adds("glass", ball(Dielectric, 1), {"clear_glass"});
    adds("frosted glass", ball(RoughDielectric, 0.5f), {"frosted_glass"});
    adds("metal", ball(RoughConductor, 0.5f), {"conductors"});
    adds("glTF", ball(MetallicRoughness, 0.5f), {"metallic_roughness"});
    adds("coat", [&](Scene& s) { ball(MetallicRoughness, 0.5f)(s), s.materials.back().clearcoat = 0.5f; },
         {"metallic_roughness", "clearcoat"});
    adds("sheen", [&](Scene& s) { ball(MetallicRoughness, 0.5f)(s), s.materials.back().sheenColor = Vec3f(0.5f); },
         {"metallic_roughness", "sheen"});
    adds("pane", [&](Scene& s) { ball(Dielectric, 1)(s), s.materials.back().thin = true; },
         {"clear_glass", "partial_glass"});
    adds("absorption",
         [&](Scene& s) {
             ball(Dielectric, 1)(s), s.materials.back().attenuationDistance = 1.0f,
                                     s.materials.back().attenuationColor = Vec3f(0.5f);
         },
         {"clear_glass", "touching_glass", "absorption"});
    adds("milk", [&](Scene& s) { ball(Dielectric, 1)(s), s.materials.back().scatteringDistance = 1.0f; },
         {"clear_glass", "touching_glass", "scattering"});
    adds("dispersion", [&](Scene& s) { ball(Dielectric, 1)(s), s.materials.back().abbeNumber = 30.0f; },
         {"clear_glass", "dispersion"});
    adds("a pane, which does not disperse",
         [&](Scene& s) {
             ball(Dielectric, 1)(s), s.materials.back().thin = true, s.materials.back().abbeNumber = 30.0f;
         },
         {"clear_glass", "partial_glass"});
    adds("nested glass",
         [&](Scene& s) {
             ball(Dielectric, 1)(s), s.spheres.push_back({{0, 1, 0}, 0.2f, s.spheres.back().material});
         },
         {"clear_glass", "touching_glass"});
    adds("texture", [](Scene& s) { floorOf(s).baseColorTexture = addTexture(s); }, {"attributes", "textures"});
    adds("nearest", [](Scene& s) { floorOf(s).baseColorTexture = addTexture(s), s.textures[0].nearest = true; },
         {"attributes", "textures", "nearest_texels"});
    adds("normal map", [](Scene& s) { floorOf(s).normalTexture = addTexture(s), s.textures[0].srgb = false; },
         {"attributes", "normal_maps"});
    adds("holes", [](Scene& s) { floorOf(s).baseColorTexture = addTexture(s), floorOf(s).alphaCutoff = 0.1f; },
         {"attributes", "textures", "alpha"});
    adds("blending", [](Scene& s) { floorOf(s).coverage = 0.5f; }, {"alpha", "blending"});
    adds("colours", [](Scene& s) { s.meshes[0].colors.assign(4, {1, 1, 1, 1}); }, {"attributes", "vertex_colors"});
    adds("lamp",
         [](Scene& s) {
             addHorizontalSquare(s, {0, 7, 0}, 1, 1, false), s.meshes[1].uvs.clear();
         },
         {"glowing_surfaces"});
    adds("point", [](Scene& s) { addPointLight(s, {0, 5, 0}, Vec3f(1.0f)); }, {"points"});
    adds("spot", [](Scene& s) { s.spotLights = {{{0, 5, 0}, {0, -1, 0}, Vec3f(1.0f)}}; }, {"spots"});
    adds("sun", [](Scene& s) { s.directionalLights = {{{0, -1, 0}, Vec3f(1.0f)}}; }, {"suns"});
    adds("sky", [](Scene& s) { setConstantSky(s, Vec3f(1.0f)); }, {"sky"});
    adds("sky map",
         [](Scene& s) {
             s.environment = Environment{Vec3f(1.0f), 2, 1, {Vec3f(1.0f), Vec3f(2.0f)}, 0, false};
         },
         {"sky", "sky_map"});
    adds("lens", [](Scene& s) { s.camera.lensRadius = 0.1f; }, {"lens"});
    adds("orthographic", [](Scene& s) { s.camera.orthographicHeight = 2; }, {"orthographic"});
}

TEST(SceneEffects, WhatIsTakenAwayIsGoneAndLittleElse) {
    Scene scene = plainScene();
    floorOf(scene).baseColorTexture = addTexture(scene);
    floorOf(scene).normalTexture = addTexture(scene);
    floorOf(scene).alphaCutoff = 0.1f;
    scene.meshes[0].colors.assign(4, {1, 1, 1, 1});
    scene.spheres.push_back({{0, 1, 0}, 0.5f, addGlass(scene)});
    scene.materials.back().attenuationDistance = 1.0f;
    scene.materials.back().attenuationColor = Vec3f(0.5f);
    scene.materials.back().abbeNumber = 30.0f;
    scene.materials.back().scatteringDistance = 1.0f;
    scene.spheres.push_back({{0, 3, 0}, 0.5f, addMaterial(scene, MaterialKind::MetallicRoughness, Vec3f(0.5f), 0.5f)});
    scene.materials.back().clearcoat = 0.5f;
    scene.materials.back().sheenColor = Vec3f(0.5f);
    scene.environment = Environment{Vec3f(1.0f), 2, 1, {Vec3f(1.0f), Vec3f(2.0f)}, 0, false};
    scene.camera.lensRadius = 0.1f;
    const Keys all = present(scene);
    // Holes are in textures.
    const std::set<std::pair<std::string, std::string>> takenAlong{{"textures", "alpha"}};
    int removable = 0;
    for (const SceneEffect& effect : sceneEffects(scene)) {
        if (!effect.removable) continue;
        ++removable;
        Keys expected = all;
        expected.erase(effect.key);
        for (const auto& [taken, along] : takenAlong)
            if (taken == effect.key) expected.erase(along);
        EXPECT_EQ(present(sceneWithout(scene, effect.key)), expected) << effect.key;
    }
    EXPECT_EQ(removable, 11);
    EXPECT_THROW(sceneWithout(scene, "triangles"), std::logic_error);
    // Bodies that neither absorb nor scatter nor touch need not be told apart.
    const Keys clear = present(sceneWithout(sceneWithout(scene, "absorption"), "scattering"));
    EXPECT_FALSE(clear.contains("touching_glass"));
}

TEST(SceneEffects, HaveNamesOfTheirOwn) {
    Keys keys, names;
    for (const SceneEffect& effect : sceneEffects(plainScene())) {
        EXPECT_TRUE(keys.insert(effect.key).second) << effect.key;
        EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
        EXPECT_FALSE(std::string(effect.meaning).empty()) << effect.key;
    }
}

}  // namespace
}  // namespace antipode::test
