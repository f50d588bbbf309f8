// glTF 2.0 through importModel(): materials, nodes, lights, cameras, and broken files.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/pane_or_body.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using nlohmann::json;
using testing::inputErrorOf;
using testing::TriangleGltf;

class GltfImport : public testing::ModelFiles {
protected:
    Scene import(const TriangleGltf& file) { return importModel(write("m.glb", file.glb())); }
    Material material(const char* entry) {
        TriangleGltf file;
        file.json["materials"][0] = json::parse(entry);
        return import(file).materials.at(0);
    }
};

TEST_F(GltfImport, DefaultsAreTheFormats) {
    const Material m = material(R"({"name": "paint"})");
    EXPECT_EQ(m.name, "paint");
    EXPECT_EQ(m.kind, MaterialKind::MetallicRoughness);
    EXPECT_EQ(m.baseColor, Vec3f(1.0f));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_TRUE(m.twoSided);
    EXPECT_FALSE(m.emitsBothSides);
}

TEST_F(GltfImport, EmissiveStrengthMultiplies) {
    EXPECT_EQ(material(R"({"emissiveFactor": [1, 0.5, 0.25],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 100}}})")
                  .emission,
              Vec3f(100, 50, 25));
}

TEST_F(GltfImport, DoubleSidedEmittersEmitOnBothSides) {
    EXPECT_TRUE(material(R"({"emissiveFactor": [1, 1, 1], "doubleSided": true})").emitsBothSides);
    EXPECT_FALSE(material(R"({"emissiveFactor": [1, 1, 1]})").emitsBothSides);
    EXPECT_FALSE(material(R"({"doubleSided": true})").emitsBothSides);
}

TEST_F(GltfImport, UnlitIsEmission) {
    TriangleGltf file;
    file.json["materials"][0] = json::parse(R"({"name": "sign", "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.5, 0.1, 1]}, "extensions": {"KHR_materials_unlit": {}}})");
    const Scene scene = import(file);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.emission, Vec3f(0.9f, 0.5f, 0.1f));
    EXPECT_TRUE(m.emitsBothSides);
    EXPECT_EQ(m.kind, MaterialKind::Lambert);
    EXPECT_EQ(m.baseColor, Vec3f());
    ASSERT_FALSE(scene.notices.empty());
    EXPECT_NE(scene.notices[0].find("'sign' is unlit"), std::string::npos) << scene.notices[0];
}

TEST_F(GltfImport, NoMetalAndNoSpecularIsLambert) {
    const Material m = material(R"({"doubleSided": true, "pbrMetallicRoughness":
        {"metallicFactor": 0, "baseColorFactor": [0.1, 0.2, 0.3, 1]},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})");
    EXPECT_EQ(m.kind, MaterialKind::Lambert);
    EXPECT_EQ(m.baseColor, Vec3f(0.1f, 0.2f, 0.3f));
    EXPECT_TRUE(m.twoSided);
}

TEST_F(GltfImport, SpecularExtension) {
    const Material m = material(R"({"pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0.25]}}})");
    EXPECT_EQ(m.kind, MaterialKind::MetallicRoughness);
    EXPECT_EQ(m.specularFactor, 0.5f);
    EXPECT_EQ(m.specular, Vec3f(1, 0.5f, 0.25f));
}

TEST_F(GltfImport, SpecularGlossinessIsADielectricOfItsReflectance) {
    const Material m = material(R"({"alphaMode": "BLEND", "extensions": {"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor": [0.8, 0.4, 0.2, 0.5], "specularFactor": [0.25, 0.125, 0], "glossinessFactor": 0.75}}})");
    EXPECT_EQ(m.kind, MaterialKind::MetallicRoughness);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_FLOAT_EQ(m.ior, 3) << "((3 − 1)/(3 + 1))² is 1/4";
    EXPECT_EQ(m.specular, Vec3f(1, 0.5f, 0));
    EXPECT_FLOAT_EQ(m.baseColor.x, 0.6f);
    EXPECT_EQ(m.coverage, std::optional(0.5f)) << "of the diffuse factor";
}

TEST_F(GltfImport, Transmission) {
    const Material smooth =
        material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0}, "extensions":
        {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.8}}})");
    EXPECT_EQ(smooth.kind, MaterialKind::Dielectric);
    EXPECT_EQ(smooth.ior, 1.8f);
    const Material rough =
        material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0.3, "metallicFactor": 0}, "extensions":
        {"KHR_materials_transmission": {"transmissionFactor": 1}}})");
    EXPECT_EQ(rough.kind, MaterialKind::RoughDielectric);
    EXPECT_EQ(rough.roughness, 0.3f);
}

TEST_F(GltfImport, SharesOfGlassTintsAndVolumes) {
    const Material share = material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.4}}})");
    EXPECT_EQ(share.kind, MaterialKind::MetallicRoughness);
    EXPECT_EQ(share.transmission, 0.4f);
    EXPECT_TRUE(share.thin) << "no thickness";
    const Material body = material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0,
        "baseColorFactor": [0.2, 0.8, 0.4, 1]}, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 1, "attenuationColor": [0.2, 0.8, 0.3],
        "attenuationDistance": 0.5}}})");
    EXPECT_EQ(body.kind, MaterialKind::MetallicRoughness) << "tinted";
    EXPECT_EQ(body.baseColor, Vec3f(0.2f, 0.8f, 0.4f));
    EXPECT_FALSE(body.thin);
    EXPECT_EQ(body.attenuationColor, Vec3f(0.2f, 0.8f, 0.3f));
    EXPECT_EQ(body.attenuationDistance, std::optional(0.5f));
    EXPECT_FALSE(body.abbeNumber);
    const Material diamond = material(R"({"pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 2.4},
        "KHR_materials_volume": {"thicknessFactor": 1}, "KHR_materials_dispersion": {"dispersion": 0.5}}})");
    EXPECT_EQ(diamond.kind, MaterialKind::Dielectric);
    EXPECT_EQ(diamond.abbeNumber, std::optional(40.0f));
    EXPECT_FALSE(material(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})").transmits())
        << "metal throughout";
}

TEST_F(GltfImport, ClearcoatAndSheen) {
    TriangleGltf file;
    file.json["materials"][0] = json::parse(R"({"name": "silk", "pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.7, "clearcoatRoughnessFactor": 0.2},
        "KHR_materials_sheen": {"sheenColorFactor": [0.9, 0.5, 0.1], "sheenRoughnessFactor": 0.4}}})");
    const Scene scene = import(file);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.kind, MaterialKind::MetallicRoughness) << "not Lambert, although nothing else is specular";
    EXPECT_EQ(m.clearcoat, 0.7f);
    EXPECT_EQ(m.clearcoatRoughness, 0.2f);
    EXPECT_EQ(m.sheenColor, Vec3f(0.9f, 0.5f, 0.1f));
    EXPECT_EQ(m.sheenRoughness, 0.4f);
    for (const std::string& notice : scene.notices) EXPECT_EQ(notice.find("'silk'"), std::string::npos) << notice;
    EXPECT_EQ(material(R"({"pbrMetallicRoughness": {"metallicFactor": 0},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0}, "KHR_materials_sheen": {}}})")
                  .kind,
              MaterialKind::Lambert)
        << "sheen is black by default";
}

TEST_F(GltfImport, WhatLayersLackIsSaid) {
    const auto notices = [&](const char* entry) {
        TriangleGltf file;
        file.json["materials"][0] = json::parse(entry);
        std::string all;
        for (const std::string& notice : import(file).notices) all += notice + "\n";
        return all;
    };
    EXPECT_NE(notices(R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1,
        "clearcoatNormalTexture": {"index": 0}}}})")
                  .find("normal map of its clear coat is ignored"),
              std::string::npos);
    EXPECT_NE(notices(R"({"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1],
        "sheenRoughnessFactor": 0.1}}})")
                  .find("roughness of its sheen became .26"),
              std::string::npos);
    EXPECT_NE(notices(R"({"pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_clearcoat":
        {"clearcoatFactor": 1}, "KHR_materials_transmission": {"transmissionFactor": 0.5}}})")
                  .find("cover what is not glass"),
              std::string::npos);
}

/// A tetrahedron and a triangle of one material without a thickness: the closed mesh becomes a body.
TEST_F(GltfImport, ClosedMeshesOfGlassAreSolid) {
    TriangleGltf file;
    file.json["materials"][0] = json::parse(R"({"pbrMetallicRoughness": {"roughnessFactor": 0, "metallicFactor": 0},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})");
    Scene scene = import(file);
    EXPECT_TRUE(scene.materials.at(0).thin);
    Mesh closed = scene.meshes.at(0);
    closed.normals.clear();
    closed.uvs.clear();
    closed.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    closed.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    scene.meshes.push_back(closed);
    makeClosedGlassSolid(scene);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_TRUE(scene.materials[scene.meshes[0].material].thin);
    EXPECT_FALSE(scene.materials[scene.meshes[1].material].thin);
    scene.meshes.erase(scene.meshes.begin());
    scene.meshes[0].material = 0;
    makeClosedGlassSolid(scene);
    EXPECT_EQ(scene.materials.size(), 2u) << "no sheet is left: the material itself changes";
    EXPECT_FALSE(scene.materials[0].thin);
}

TEST_F(GltfImport, MaterialsAreMatchedByIndexNotByNameOrOrderOfUse) {
    TriangleGltf file;
    // Three materials of one name; the first is unused, the others are used in reverse order.
    file.json["materials"] = json::parse(R"([{"name": "same", "emissiveFactor": [1, 0, 0]},
        {"name": "same", "emissiveFactor": [0, 1, 0]}, {"name": "same", "emissiveFactor": [0, 0, 1]}])");
    file.json["meshes"] = json::parse(R"([
        {"name": "blue", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 2}]},
        {"name": "green", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 1}]},
        {"name": "none", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}])");
    file.json["nodes"] = json::parse(R"([{"mesh": 0}, {"mesh": 1}, {"mesh": 2}])");
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = import(file);
    ASSERT_EQ(scene.meshes.size(), 3u);
    for (const Mesh& mesh : scene.meshes) {
        const Vec3f expected = mesh.name == "blue" ? Vec3f(0, 0, 1) : mesh.name == "green" ? Vec3f(0, 1, 0) : Vec3f();
        EXPECT_EQ(scene.materials.at(mesh.material).emission, expected) << mesh.name;
    }
    EXPECT_EQ(scene.materials.size(), 3u) << "green, blue and the format's default";
}

TEST_F(GltfImport, InstancesAreFlattenedAndMirrorsKeepFronts) {
    TriangleGltf file;
    file.json["nodes"] = json::parse(R"([{"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "scale": [1, 1, -1]}, {"mesh": 0, "translation": [0, 5, 0]}])");
    const Scene scene = import(file);
    ASSERT_EQ(scene.meshes.size(), 2u);
    for (const Mesh& mesh : scene.meshes) {
        const auto& t = mesh.triangles.at(0);
        const Vec3f normal =
            cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
        const bool mirrored = mesh.positions[0].y == 0;
        EXPECT_EQ(normal, Vec3f(0, 0, mirrored ? -1 : 1));
        EXPECT_EQ(mesh.positions[t[0]].x, 10);
    }
}

TEST_F(GltfImport, CameraKeepsItsVerticalFieldOfView) {
    TriangleGltf file;
    file.json["cameras"] =
        json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.7, "aspectRatio": 2, "znear": 0.1}}])");
    file.json["nodes"].push_back(json::parse(
        R"({"camera": 0, "translation": [1, 2, 3], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]})"));
    file.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = import(file);
    EXPECT_FLOAT_EQ(scene.camera.verticalFov, 0.7f);
    EXPECT_EQ(scene.camera.position, Vec3f(1, 2, 3));
    EXPECT_NEAR(scene.camera.forward.x, -1, 1e-6);
    EXPECT_EQ(scene.imageWidth, 2 * scene.imageHeight);
}

TEST_F(GltfImport, PunctualLights) {
    TriangleGltf file;
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
        {"type": "point", "color": [1, 0.5, 0.25], "intensity": 8},
        {"type": "directional", "intensity": 3},
        {"type": "spot", "intensity": 5, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}}])");
    for (int i = 0; i < 3; ++i) {
        file.json["nodes"].push_back(
            {{"translation", {i, 7, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
        file.json["scenes"][0]["nodes"].push_back(i + 1);
    }
    const Scene scene = import(file);
    ASSERT_EQ(scene.pointLights.size(), 1u);
    ASSERT_EQ(scene.directionalLights.size(), 1u);
    ASSERT_EQ(scene.spotLights.size(), 1u);
    EXPECT_EQ(scene.pointLights[0].intensity, Vec3f(8, 4, 2));
    EXPECT_EQ(scene.pointLights[0].position, Vec3f(0, 7, 0));
    EXPECT_EQ(scene.directionalLights[0].direction, Vec3f(0, 0, -1));
    EXPECT_EQ(scene.directionalLights[0].irradiance, Vec3f(3.0f));
    EXPECT_EQ(scene.spotLights[0].position, Vec3f(2, 7, 0));
    EXPECT_FLOAT_EQ(scene.spotLights[0].innerHalfAngle, 0.2f);
    EXPECT_FLOAT_EQ(scene.spotLights[0].outerHalfAngle, 0.6f);
    EXPECT_FALSE(scene.environment.has_value());
}

TEST_F(GltfImport, EmbeddedTextureAndAlpha) {
    TriangleGltf file;
    const std::vector<uint8_t> png = testing::makePng();
    file.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", file.binary.size()}, {"byteLength", png.size()}});
    file.binary.insert(file.binary.end(), png.begin(), png.end());
    file.json["buffers"][0]["byteLength"] = file.binary.size();
    file.json["images"] = json::parse(R"([{"bufferView": 2, "mimeType": "image/png"}])");
    file.json["samplers"] = json::parse(R"([{"wrapS": 33071, "wrapT": 33648}])");
    file.json["textures"] = json::parse(R"([{"source": 0, "sampler": 0}])");
    file.json["materials"][0] = json::parse(R"({"alphaMode": "BLEND",
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}},
        "normalTexture": {"index": 0, "scale": 0.5}})");
    const Scene scene = import(file);
    const Material& m = scene.materials.at(0);
    ASSERT_TRUE(m.baseColorTexture && m.metallicRoughnessTexture && m.normalTexture);
    EXPECT_TRUE(scene.textures[*m.baseColorTexture].srgb);
    EXPECT_FALSE(scene.textures[*m.metallicRoughnessTexture].srgb);
    EXPECT_EQ(m.metallicRoughnessTexture, m.normalTexture) << "decoded once";
    EXPECT_EQ(scene.textures[0].width, 2u);
    EXPECT_EQ(scene.textures[0].wrapU, WrapMode::Clamp);
    EXPECT_EQ(scene.textures[0].wrapV, WrapMode::Mirror);
    EXPECT_EQ(m.coverage, std::optional(1.0f)) << "times the texture's alpha";
    EXPECT_FALSE(m.alphaCutoff.has_value());
    EXPECT_EQ(m.normalScale, 0.5f);
}

TEST_F(GltfImport, BlendingByTheFactorAlone) {
    EXPECT_EQ(
        material(R"({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.3]}})").coverage,
        std::optional(0.3f));
    EXPECT_FALSE(material(R"({"alphaMode": "BLEND"})").coverage.has_value()) << "opaque all the same";
}

TEST_F(GltfImport, MaskKeepsItsCutoff) {
    EXPECT_EQ(material(R"({"alphaMode": "MASK", "alphaCutoff": 0.3})").alphaCutoff, std::optional(0.3f));
    EXPECT_EQ(material(R"({"alphaMode": "MASK", "alphaCutoff": 0.3,
        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})")
                  .alphaCutoff,
              std::optional(0.6f));
    EXPECT_FALSE(material(R"({"alphaCutoff": 0.3})").alphaCutoff.has_value());
}

/// Factor and cut-off decide alone where there is no texture: below it nothing is there, at it or above it all.
TEST_F(GltfImport, MaskByTheFactorAlone) {
    const auto cutoff = [&](const std::string& factor, const std::string& written) {
        const std::string text = R"({"alphaMode": "MASK", "alphaCutoff": )" + written +
                                 R"(, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, )" + factor + "]}}";
        return *material(text.c_str()).alphaCutoff;
    };
    for (const char* below : {"0", "0.1", "0.49999"}) EXPECT_GT(cutoff(below, "0.5"), 1.0f) << below;
    for (const char* reached : {"0.5", "0.50001", "1"}) EXPECT_LE(cutoff(reached, "0.5"), 1.0f) << reached;
    EXPECT_LE(cutoff("0.1", "0.1"), 1.0f);
    EXPECT_LE(cutoff("0", "0"), 0.0f) << "a cut-off of 0 leaves what is wholly transparent";
}

TEST_F(GltfImport, AFileCutAnywhereIsAnError) {
    const std::vector<uint8_t> glb = TriangleGltf().glb();
    for (size_t size = 0; size < glb.size(); size += 7) {
        const std::string path = write("cut.glb", std::vector<uint8_t>(glb.begin(), glb.begin() + long(size)));
        EXPECT_THROW(importModel(path), Error) << size << " of " << glb.size();
    }
}

TEST_F(GltfImport, NonFiniteVertexNamesTheMesh) {
    for (float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        TriangleGltf file;
        file.setPosition(1, 0, value);
        const std::string message = inputErrorOf([&] { import(file); });
        EXPECT_NE(message.find("mesh 'triangle': position 1"), std::string::npos) << message;
    }
}

TEST_F(GltfImport, BadIndexNamesTheMesh) {
    TriangleGltf file;
    file.setIndex(2, 3);
    const std::string message = inputErrorOf([&] { import(file); });
    EXPECT_NE(message.find("'triangle'"), std::string::npos) << message;
}

TEST_F(GltfImport, LyingAccessorsAndViewsAreErrors) {
    const char* pointers[] = {"/accessors/0/count",
                              "/accessors/1/count",
                              "/bufferViews/0/byteLength",
                              "/bufferViews/1/byteOffset",
                              "/buffers/0/byteLength",
                              "/accessors/0/bufferView",
                              "/accessors/0/componentType",
                              "/meshes/0/primitives/0/attributes/POSITION",
                              "/meshes/0/primitives/0/indices",
                              "/meshes/0/primitives/0/material",
                              "/nodes/0/mesh"};
    for (const char* pointer : pointers) {
        TriangleGltf file;
        file.json[json::json_pointer(pointer)] = 1000;
        EXPECT_THROW(import(file), Error) << pointer;
    }
}

TEST_F(GltfImport, TextFileWithExternalOrInlineBuffer) {
    TriangleGltf file;
    write("the buffer.bin", file.binary);
    file.json["buffers"][0]["uri"] = "the%20buffer.bin";
    EXPECT_EQ(importModel(write("m.gltf", file.json.dump())).meshes.at(0).positions.size(), 3u);

    // 44 bytes: (0,0,0) (1,0,0) (0,1,0), then 0, 1, 2 and padding.
    file.json["buffers"][0]["uri"] =
        "data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA=";
    EXPECT_EQ(importModel(write("m.gltf", file.json.dump())).meshes.at(0).positions[1], Vec3f(1, 0, 0));

    file.json["buffers"][0]["uri"] = "gone.bin";
    EXPECT_NE(inputErrorOf([&] { importModel(write("m.gltf", file.json.dump())); }).find("gone.bin"),
              std::string::npos);
    write("short.bin", std::vector<uint8_t>(file.binary.begin(), file.binary.begin() + 22));
    file.json["buffers"][0]["uri"] = "short.bin";
    EXPECT_NE(inputErrorOf([&] { importModel(write("m.gltf", file.json.dump())); }).find("cut short"),
              std::string::npos);
}

TEST_F(GltfImport, UnknownRequiredExtensionIsNamed) {
    TriangleGltf file;
    file.json["extensionsRequired"] = {"ACME_teapots"};
    EXPECT_NE(inputErrorOf([&] { import(file); }).find("ACME_teapots"), std::string::npos);
}

TEST_F(GltfImport, UnknownExtensionsThatAreUsedAreOneNoticeEach) {
    TriangleGltf file;
    file.json["extensionsUsed"] = {"ACME_teapots", "KHR_materials_ior", "KHR_xmp_json_ld"};
    file.json["nodes"][0]["extensions"]["ACME_springs"] = {{"stiffness", 1}};
    file.json["materials"][0]["extensions"]["ACME_teapots"] = json::object();
    const std::vector<std::string> notices = import(file).notices;
    for (const char* name : {"ACME_teapots", "ACME_springs"})
        EXPECT_EQ(std::count_if(notices.begin(), notices.end(),
                                [&](const std::string& n) { return n.find(name) != std::string::npos; }),
                  1)
            << name;
    for (const std::string& notice : notices) EXPECT_EQ(notice.find("KHR_"), std::string::npos) << notice;
}

TEST_F(GltfImport, WrongTypesInJsonAreErrors) {
    for (const char* entry : {R"({"emissiveFactor": "red"})", R"({"pbrMetallicRoughness": 5})",
                              R"({"pbrMetallicRoughness": {"baseColorFactor": [1]}})",
                              R"({"extensions": {"KHR_materials_ior": {"ior": "x"}}})"}) {
        TriangleGltf file;
        file.json["materials"][0] = json::parse(entry);
        EXPECT_THROW(import(file), Error) << entry;
    }
}

TEST_F(GltfImport, TheFirstVersionIsReadAsWell) {
    const std::string positions = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";  // (0,0,0), (1,0,0), (0,1,0)
    for (const char* version : {"\"1.0\"", "1.0"}) {
        const std::string text = R"({"asset":{"version":)" + std::string(version) +
                                 R"(},"scene":"s","scenes":{"s":{"nodes":["n"]}},
            "nodes":{"n":{"meshes":["m"]}},"materials":{"p":{"values":{"diffuse":[0.5,0.25,0.125,1]}}},
            "meshes":{"m":{"primitives":[{"attributes":{"POSITION":"a"},"material":"p","mode":4}]}},
            "accessors":{"a":{"bufferView":"v","byteOffset":0,"byteStride":12,"componentType":5126,"count":3,
            "type":"VEC3"}},"bufferViews":{"v":{"buffer":"b","byteOffset":0,"byteLength":36}},
            "buffers":{"b":{"byteLength":36,"type":"arraybuffer","uri":"data:application/octet-stream;base64,)" +
                                 positions + R"("}}})";
        const Scene scene = importModel(write("v1.gltf", text));
        ASSERT_EQ(scene.meshes.at(0).positions.size(), 3u);
        EXPECT_EQ(scene.materials.at(scene.meshes[0].material).baseColor, Vec3f(0.5f, 0.25f, 0.125f));
    }
}

}  // namespace
}  // namespace antipode
