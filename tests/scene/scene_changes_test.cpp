// What --camera, --environment and --set make of scenes.
#include "proto/scene_changes.h"

#include <nlohmann/json.hpp>

#include "proto/scene_loader.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "tests/scene/gltf_files.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

const std::string kScene = R"(
    camera { position: [0, 0, 5] look_at: [0, 0, 0] }
    material { name: "Clay.001" roughness: 0.5 kind: METALLIC_ROUGHNESS }
    material { name: "Clay" }
    sphere { radius: 1 material: "Clay" }
    quad { material: "Clay" corner: [0, 0, 0] edge_u: [1, 0, 0] edge_v: [0, 1, 0] }
    point_light { position: [0, 5, 0] intensity: [1, 1, 1] }
)";

Scene changed(const std::vector<FieldChange>& fields) { return parseScene(kScene, "t", ".", {}, {{}, fields}); }

std::string usageErrorOf(const std::string& path, const std::string& value) {
    try {
        changed({{path, value}});
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Usage);
        return error.what();
    }
    ADD_FAILURE() << path << " was accepted";
    return "";
}

TEST(SceneChanges, FieldsOfWhatTheTextHas) {
    const Scene scene = changed({{"camera.position", "3,0,0"},
                                 {"material.Clay.001.roughness", ".25"},
                                 {"material.Clay.base_color", "1,0,0"},
                                 {"sphere.radius", "2"},
                                 {"quad[0].edge_u", "4,0,0"},
                                 {"quad[0].material", "Clay.001"},
                                 {"point_light[1].position", "1,2,3"},
                                 {"point_light[1].intensity", "4,4,4"},
                                 {"image.width", "400"},
                                 {"max_path_length", "7"}});
    EXPECT_EQ(scene.camera.position, Vec3f(3, 0, 0));
    EXPECT_EQ(scene.camera.forward, Vec3f(-1, 0, 0)) << "it goes on looking at the point";
    EXPECT_EQ(scene.materials[0].roughness, .25f);
    EXPECT_EQ(scene.materials[1].baseColor, Vec3f(1, 0, 0));
    EXPECT_EQ(scene.spheres[0].radius, 2);
    EXPECT_EQ(scene.meshes[0].positions[1], Vec3f(4, 0, 0));
    EXPECT_EQ(scene.meshes[0].material, 0u);
    ASSERT_EQ(scene.pointLights.size(), 2u);
    EXPECT_EQ(scene.pointLights[1].position, Vec3f(1, 2, 3));
    EXPECT_EQ(scene.imageWidth, 400u);
    EXPECT_EQ(scene.imageHeight, 512u) << "keeps its default";
    EXPECT_EQ(scene.maxPathLength, 7u);
}

TEST(SceneChanges, WhatExcludesAFieldGoes) {
    EXPECT_EQ(changed({{"camera.forward", "0,0,2"}}).camera.forward, Vec3f(0, 0, 1));
    EXPECT_EQ(changed({{"camera.forward", "0,0,2"}, {"camera.look_at", "5,0,5"}}).camera.forward, Vec3f(1, 0, 0));
    EXPECT_FLOAT_EQ(changed({{"camera.focal_length", "18"}}).camera.verticalFov, 1.57079633f);
    EXPECT_FLOAT_EQ(changed({{"camera.focal_length", "50"}, {"camera.f_stop", "2"}}).camera.lensRadius, 0.0125f);
}

TEST(SceneChanges, AStarIsAll) {
    const Scene scene = changed({{"material.*.base_color", "0,1,0"}, {"material.*.kind", "LAMBERT"}});
    for (const Material& material : scene.materials) {
        EXPECT_EQ(material.baseColor, Vec3f(0, 1, 0));
        EXPECT_EQ(material.kind, MaterialKind::Lambert);
    }
}

TEST(SceneChanges, NothingChangesNothing) {
    EXPECT_EQ(sceneHash(changed({{"camera.lens_radius", "0"}})), sceneHash(changed({})));
    EXPECT_NE(sceneHash(changed({{"camera.lens_radius", "1"}})), sceneHash(changed({})));
}

TEST(SceneChanges, MistakesAreNamed) {
    EXPECT_EQ(
        usageErrorOf("camera.postion", "0,1,2"),
        "--set camera.postion names no field: a Camera has no 'postion'. Did you mean 'position', which takes numbers, "
        "parted by commas?");
    EXPECT_EQ(usageErrorOf("camera.position", "0,one,2"),
              "--set camera.position takes numbers, parted by commas, not '0,one,2'.");
    EXPECT_EQ(usageErrorOf("camera.lens_radius", "1,2"), "--set camera.lens_radius takes a number, not '1,2'.");
    EXPECT_EQ(usageErrorOf("material.Clya.ior", "2"),
              "--set material.Clya.ior finds no material 'Clya'. Did you mean 'Clay'?");
    EXPECT_EQ(usageErrorOf("material.Oak.ior", "2"),
              "--set material.Oak.ior finds no material 'Oak'. There are Clay.001, Clay.");
    EXPECT_EQ(usageErrorOf("sphere[3].radius", "2"),
              "--set sphere[3].radius is of sphere #3, but there are 1, counted from 0.");
    EXPECT_EQ(usageErrorOf("box[0].low", "0,0,0"), "--set box[0].low finds nothing: the scene has no such object.");
    EXPECT_EQ(usageErrorOf("material.Clay.kind", "WOOD").rfind("--set material.Clay.kind takes one of LAMBERT, ", 0),
              0u);
    EXPECT_EQ(usageErrorOf("camera", "1").rfind("--set camera is not one value: name one of its fields: position", 0),
              0u);
    EXPECT_EQ(usageErrorOf("camera.position.x", "1"),
              "--set camera.position.x goes on after 'position', which takes numbers, parted by commas.");
    EXPECT_EQ(usageErrorOf("texture[0", "1").rfind("--set texture[0 needs a number", 0), 0u);
    EXPECT_EQ(testing::inputErrorOf([] {
                  changed({{"camera.position", "1,2"}});
              }),
              "t: camera: position needs three numbers, not 2");
    EXPECT_EQ(testing::inputErrorOf([] { changed({{"material.Clay.base_color", "2,0,0"}}); }).rfind("t: ", 0), 0u);
}

class ModelChanges : public testing::ModelFiles {
protected:
    /// A square with a material, looked at by two cameras.
    std::string model() {
        testing::GltfFile file;
        const size_t positions = file.addAccessor(testing::squarePositions(), "VEC3");
        file.json["materials"] = {{{"name", "Oak"}, {"pbrMetallicRoughness", {{"roughnessFactor", .5}}}}};
        const size_t node = file.addMesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}, {"material", 0}});
        const nlohmann::json lens = {{"type", "perspective"}, {"perspective", {{"yfov", .5}, {"znear", .1}}}};
        file.json["cameras"] = {lens, lens, lens};
        file.json["cameras"][0]["name"] = "front";
        file.json["cameras"][1]["name"] = "side";
        const size_t front = file.add("nodes", {{"camera", 0}, {"translation", {0, 0, 5}}});
        const size_t side = file.add("nodes", {{"camera", 1}, {"translation", {0, 0, 6}}, {"name", "Camera.001"}});
        const size_t top = file.add("nodes", {{"camera", 2}, {"translation", {0, 0, 7}}, {"name", "top"}});
        file.json["scenes"] = {{{"nodes", {node, front, side, top}}}};
        return write("m.glb", file.glb());
    }
    std::string map() {
        const std::string path = (directory_ / "sky.exr").string();
        writeExr(path, {2, 1, {Vec3f(1, 2, 3), Vec3f(4, 5, 6)}}, {});
        return path;
    }
};

TEST_F(ModelChanges, CamerasAreChosenByName) {
    const std::string path = model();
    const auto through = [&](std::optional<std::string> camera) {
        ImportOptions options;
        options.camera = std::move(camera);
        return loadScene(path, options);
    };
    const Scene first = through({});
    EXPECT_EQ(first.camera.position.z, 5);
    EXPECT_EQ(first.notices.at(0),
              "The file has 3 cameras; the first, 'front', is used. --camera takes another: 'side', 'top'.");
    EXPECT_EQ(through("side").camera.position.z, 6);
    EXPECT_EQ(through("Camera.001").camera.position.z, 6);
    EXPECT_EQ(through("top").camera.position.z, 7);
    EXPECT_NE(
        testing::inputErrorOf([&] {
            through("Side");
        }).find("it has no camera 'Side' (--camera); its cameras are 'front', 'side', 'top'. Did you mean 'side'?"),
        std::string::npos);
}

TEST_F(ModelChanges, AnEnvironmentLightsAModelInsteadOfTheStudio) {
    const Scene scene = loadScene(model(), {}, {map(), {{"environment.rotation", "90"}}});
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->map.at(1), Vec3f(4, 5, 6));
    EXPECT_EQ(scene.environment->radiance, Vec3f(1));
    EXPECT_NEAR(scene.environment->rotation, 1.5707963, 1e-6);
    for (const std::string& notice : scene.notices) EXPECT_EQ(notice.find("no light"), std::string::npos) << notice;
}

TEST_F(ModelChanges, AnEnvironmentReplacesTheTextsOwn) {
    const Scene scene = parseScene(kScene + "environment { radiance: [9, 9, 9] }", "t", ".", {},
                                   {map(), {{"environment.z_up", "true"}}});
    EXPECT_EQ(scene.environment.value().map.at(0), Vec3f(1, 2, 3));
    EXPECT_EQ(scene.environment->radiance, Vec3f(1));
    EXPECT_TRUE(scene.environment->zUp);
}

TEST_F(ModelChanges, FieldsOfModels) {
    const Scene before = loadScene(model());
    const Scene scene = loadScene(model(), {},
                                  {{},
                                   {{"material.Oak.roughness", "0.125"},
                                    {"camera.look_at", "5,0,5"},
                                    {"point_light[0].position", "0,3,0"},
                                    {"point_light[0].intensity", "1,1,1"},
                                    {"environment.file", map()}}});
    EXPECT_EQ(scene.materials[0].roughness, .125f);
    EXPECT_EQ(scene.camera.forward, Vec3f(1, 0, 0));
    EXPECT_EQ(scene.camera.focusDistance, 5);
    EXPECT_EQ(scene.camera.verticalFov, before.camera.verticalFov);
    EXPECT_EQ(scene.pointLights.at(0).position, Vec3f(0, 3, 0));
    EXPECT_EQ(scene.environment.value().map.size(), 2u);
    EXPECT_EQ(scene.meshes[0].positions, before.meshes[0].positions);
}

TEST_F(ModelChanges, FieldsOfModelsWithinScenes) {
    model();
    const std::string path = write("s.textproto", kScene + "model { file: \"m.glb\" }");
    const Scene scene = loadScene(path, {},
                                  {{},
                                   {{"material.Oak.roughness", "0.125"},
                                    {"material.*.base_color", "0,1,0"},
                                    {"model.transform.translate", "0,0,1"}}});
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.materials[2].roughness, .125f);
    for (const Material& material : scene.materials) EXPECT_EQ(material.baseColor, Vec3f(0, 1, 0));
    EXPECT_EQ(scene.meshes.back().positions[0].z, 1);
}

}  // namespace
}  // namespace antipode
