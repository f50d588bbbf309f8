#include "proto/scene_translation.h"

#include <cmath>

#include "renderengine/sha256.h"
#include "proto/scene_loader.h"
#include "renderengine/io/text.h"
#include "tests/scene/full_scene.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::fullScene;
using testing::inputErrorOf;

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

TEST(SceneHash, AndMessageAreThoseOfEarlierBuilds) {
    // Caches, servers and checkpoints know scenes by these bytes; a new field changes the hash of every scene.
    const Scene scene = fullScene();
    EXPECT_EQ(sceneHash(scene), "5c8422195154587d9e9a3ca6893fbf6ab6ce081590a82c02fb779cdacbfce6de");
    EXPECT_EQ(hexadecimal(sha256Of(toProto(scene).SerializeAsString())),
              "ec19efb3d092a4dd3131f6b2b4433fdf17f220b734cd70a69f27a16a220c7a4d");
    EXPECT_EQ(hexadecimal(sha256Of(toProto(scene, Arrays::LeftOut).SerializeAsString())),
              "8457bb7f8a855c7339f7ac15297d5e2db6ddb0240304519e6f687ce380f34386");
    EXPECT_EQ(sceneHash(testing::smallScene()), "b361ae295b757b5f89b471b48febd8b84bab6d393ebf3f54f974367a0ed52db9");
    EXPECT_EQ(hexadecimal(sha256Of(toProto(testing::smallScene()).SerializeAsString())),
              "9b0b4c19e30e36bc3d8b58944a2abb933bd0fdc17aacdcedd9a584b3d5041d82");
}

TEST(SceneHash, IgnoresNamesAndNotices) {
    Scene scene = fullScene();
    scene.name = scene.materials[0].name = scene.meshes[0].name = scene.textures[0].name = "other";
    scene.notices.clear();
    EXPECT_EQ(sceneHash(scene), sceneHash(fullScene()));
}

TEST(SceneHash, KnowsWhatIsMissing) {
    // That it changes with every value is tested along the tables, see scene_fields_test.cpp.
    using Change = void (*)(Scene&);
    const Change changes[] = {
        [](Scene& s) { s.materials[2].baseColorTexture.reset(); },
        [](Scene& s) { s.materials[2].alphaCutoff.reset(); },
        [](Scene& s) { s.meshes[0].normals.clear(); },
        [](Scene& s) { s.environment.reset(); },
        [](Scene& s) { std::swap(s.environment->width, s.environment->height); },
        [](Scene& s) { s.pointLights.clear(); },
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
