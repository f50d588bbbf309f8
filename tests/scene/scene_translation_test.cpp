#include "proto/scene_translation.h"

#include <cmath>

#include "proto/scene_loader.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::inputErrorOf;

/// A scene in which every field differs from its default.
Scene fullScene() {
    Scene s = testing::smallScene();
    s.textures = {{"tex", 2, 1, {1, 2, 3, 4, 5, 6, 7, 8}, false, WrapMode::Clamp, WrapMode::Mirror}};
    Material m;
    m.name = "lamp";  // the name of another material, which must not matter
    m.kind = MaterialKind::MetallicRoughness;
    m.baseColor = {0.1f, 0.2f, 0.3f};
    m.specular = {0.4f, 0.5f, 0.6f};
    m.specularFactor = 0.7f;
    m.phongExponent = 12.5f;
    m.roughness = 0.35f;
    m.metallic = 0.9f;
    m.ior = 1.33f;
    m.conductorEta = {1, 2, 3};
    m.conductorK = {4, 5, 6};
    m.emission = {7, 8, 9};
    m.baseColorTexture = m.emissionTexture = m.metallicRoughnessTexture = m.normalTexture = 0;
    m.normalScale = 0.25f;
    m.alphaCutoff = 0.6f;
    m.twoSided = false;
    s.materials.push_back(m);
    s.meshes[0].normals.assign(3, Vec3f(normalize(Vec3d(1, 2, 3))));
    s.meshes[0].uvs = {{0, 0}, {0.1f, 0.9f}, {1.0f / 3, 7}};
    s.meshes[0].triangles.push_back({0, 0, 1});
    s.pointLights = {{{1, 2, 3}, {4, 5, 6}}};
    s.spotLights = {{{1, 2, 3}, Vec3f(normalize(Vec3d(3, 1, 2))), {4, 5, 6}, 0.123f, 0.789f}};
    s.directionalLights = {{Vec3f(normalize(Vec3d(-1, 2, 7))), {1, 2, 3}}};
    s.environment = Environment{{1, 2, 3}, 2, 1, {{0.1f, 0.2f, 0.3f}, {4, 5, 6}}, 1.234f, true};
    s.camera = Camera{{1, 2, 3}, Vec3f(normalize(Vec3d(1, 1, -2))), {0, 0, 1}, 0.987654f, 0.05f, 3.7f};
    s.imageWidth = 33;
    s.imageHeight = 17;
    s.maxPathLength = 9;
    s.notices = {"a notice"};
    return s;
}

TEST(SceneTranslation, RoundTripKeepsEveryField) {
    const Scene scene = fullScene();
    const Scene back = fromProto(toProto(scene));
    // The message holds every field (the hash test below shows it changes with each), so equal messages mean equal
    // scenes.
    EXPECT_EQ(toProto(back).SerializeAsString(), toProto(scene).SerializeAsString());
    EXPECT_EQ(sceneHash(back), sceneHash(scene));
    EXPECT_EQ(back.notices, scene.notices);
    EXPECT_EQ(back.name, scene.name);
    EXPECT_EQ(back.materials[2].name, "lamp");
    EXPECT_EQ(back.meshes[0].name, "triangle");
    EXPECT_EQ(back.textures[0].name, "tex");
    EXPECT_EQ(back.camera.verticalFov, scene.camera.verticalFov);
    EXPECT_EQ(back.meshes[0].triangles, scene.meshes[0].triangles) << "a resolved scene is not cleaned again";
}

TEST(SceneTranslation, AnglesKeepEveryBitThroughDegrees) {
    Scene scene = fullScene();
    float angle = 1e-3f;
    for (int i = 0; i < 100000; ++i, angle = std::nextafter(angle * 1.00007f, 4.0f)) {
        scene.spotLights[0].outerHalfAngle = angle;
        if (i % 1000 == 0) {
            ASSERT_EQ(fromProto(toProto(scene)).spotLights[0].outerHalfAngle, angle);
        }
    }
}

TEST(SceneTranslation, RefusesFilesShapesAndMissingCamerasFromTheWire) {
    const auto refuse = [](auto spoil) {
        schema::Scene message = toProto(testing::smallScene());
        spoil(message);
        inputErrorOf([&] { fromProto(message); });
    };
    refuse([](schema::Scene& m) { m.add_model()->set_file("/etc/passwd"); });
    refuse([](schema::Scene& m) { m.add_texture()->set_file("/etc/passwd"); });
    refuse([](schema::Scene& m) { m.mutable_environment()->set_file("x.exr"); });
    refuse([](schema::Scene& m) { m.add_ripple_grid()->set_cells_x(60000); });
    refuse([](schema::Scene& m) { m.clear_camera(); });
    refuse([](schema::Scene& m) { m.mutable_sphere(0)->set_material("#7"); });
}

TEST(SceneHash, IsSha256InHexadecimal) {
    const std::string hash = sceneHash(fullScene());
    EXPECT_EQ(hash.size(), 64u);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_EQ(hash, sceneHash(fullScene()));
}

TEST(SceneHash, IgnoresNamesAndNotices) {
    Scene scene = fullScene();
    scene.name = scene.materials[0].name = scene.meshes[0].name = scene.textures[0].name = "other";
    scene.notices.clear();
    EXPECT_EQ(sceneHash(scene), sceneHash(fullScene()));
}

TEST(SceneHash, ChangesWithEverythingElse) {
    using Change = void (*)(Scene&);
    const Change changes[] = {
        [](Scene& s) { s.textures[0].rgba[5] ^= 1; },
        [](Scene& s) { s.textures[0].srgb = true; },
        [](Scene& s) { s.textures[0].wrapU = WrapMode::Repeat; },
        [](Scene& s) { s.textures[0].wrapV = WrapMode::Repeat; },
        [](Scene& s) { s.materials[2].kind = MaterialKind::Lambert; },
        [](Scene& s) { s.materials[2].baseColor.x += 0.01f; },
        [](Scene& s) { s.materials[2].specular.y += 0.01f; },
        [](Scene& s) { s.materials[2].specularFactor = 0.5f; },
        [](Scene& s) { s.materials[2].phongExponent = 1; },
        [](Scene& s) { s.materials[2].roughness = 0; },
        [](Scene& s) { s.materials[2].metallic = 0; },
        [](Scene& s) { s.materials[2].ior = 2; },
        [](Scene& s) { s.materials[2].conductorEta.z = 0; },
        [](Scene& s) { s.materials[2].conductorK.z = 0; },
        [](Scene& s) { s.materials[2].emission.z = 0; },
        [](Scene& s) { s.materials[2].baseColorTexture.reset(); },
        [](Scene& s) { s.materials[2].emissionTexture.reset(); },
        [](Scene& s) { s.materials[2].metallicRoughnessTexture.reset(); },
        [](Scene& s) { s.materials[2].normalTexture.reset(); },
        [](Scene& s) { s.materials[2].normalScale = 1; },
        [](Scene& s) { s.materials[2].alphaCutoff.reset(); },
        [](Scene& s) { s.materials[2].twoSided = true; },
        [](Scene& s) { s.meshes[0].positions[0].x = std::nextafter(s.meshes[0].positions[0].x, 1.0f); },
        [](Scene& s) { s.meshes[0].normals.clear(); },
        [](Scene& s) { s.meshes[0].uvs[1][1] = 0; },
        [](Scene& s) {
            s.meshes[0].triangles[0] = {1, 2, 0};
        },
        [](Scene& s) { s.meshes[0].material = 0; },
        [](Scene& s) { s.spheres[0].center.x = 1; },
        [](Scene& s) { s.spheres[0].radius = 2; },
        [](Scene& s) { s.spheres[0].material = 1; },
        [](Scene& s) { s.pointLights[0].position.x = 0; },
        [](Scene& s) { s.pointLights[0].intensity.x = 0; },
        [](Scene& s) { s.spotLights[0].position.x = 0; },
        [](Scene& s) {
            s.spotLights[0].direction = {0, 0, 1};
        },
        [](Scene& s) { s.spotLights[0].intensity.x = 0; },
        [](Scene& s) { s.spotLights[0].innerHalfAngle = 0; },
        [](Scene& s) { s.spotLights[0].outerHalfAngle = 1; },
        [](Scene& s) {
            s.directionalLights[0].direction = {0, 0, 1};
        },
        [](Scene& s) { s.directionalLights[0].irradiance.x = 0; },
        [](Scene& s) { s.environment.reset(); },
        [](Scene& s) { s.environment->radiance.x = 0; },
        [](Scene& s) { s.environment->map[1].x = 0; },
        [](Scene& s) { std::swap(s.environment->width, s.environment->height); },
        [](Scene& s) { s.environment->rotation = 0; },
        [](Scene& s) { s.environment->zUp = false; },
        [](Scene& s) { s.camera.position.x = 0; },
        [](Scene& s) {
            s.camera.forward = {1, 0, 0};
        },
        [](Scene& s) {
            s.camera.up = {0, 1, 0};
        },
        [](Scene& s) { s.camera.verticalFov = 1; },
        [](Scene& s) { s.camera.lensRadius = 0; },
        [](Scene& s) { s.camera.focusDistance = 1; },
        [](Scene& s) { s.imageWidth = 34; },
        [](Scene& s) { s.imageHeight = 18; },
        [](Scene& s) { s.maxPathLength.reset(); },
    };
    const std::string original = sceneHash(fullScene()), message = toProto(fullScene()).SerializeAsString();
    for (size_t i = 0; i < std::size(changes); ++i) {
        Scene scene = fullScene();
        changes[i](scene);
        EXPECT_NE(sceneHash(scene), original) << "change " << i;
        EXPECT_NE(toProto(scene).SerializeAsString(), message) << "change " << i;
    }
}

}  // namespace
}  // namespace antipode
