// Geometry of glTF 2.0 in every layout that the format has, through importModel().
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/scene/gltf_files.h"

namespace antipode {
namespace {

using nlohmann::json;
using testing::GltfFile;
using testing::inputErrorOf;
using testing::squarePositions;

class GltfGeometry : public testing::ModelFiles {
protected:
    Scene import(const GltfFile& file) { return importModel(write("m.glb", file.glb())); }
    Mesh onlyMesh(const GltfFile& file) {
        Scene scene = import(file);
        EXPECT_EQ(scene.meshes.size(), 1u);
        return scene.meshes.at(0);
    }
};

using Corner = std::array<Vec3f, 3>;

/// Corners of all triangles, in order.
std::vector<Corner> cornersOf(const Mesh& mesh) {
    std::vector<Corner> corners;
    for (const auto& t : mesh.triangles)
        corners.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
    return corners;
}

Vec3f normalOf(const Corner& c) { return cross(c[1] - c[0], c[2] - c[0]); }

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (const Corner& c : cornersOf(mesh)) area += 0.5 * double(length(normalOf(c)));
    return area;
}

TEST_F(GltfGeometry, NormalisedIntegersAreFractions) {
    const auto uvsWith = [&](auto zero, auto greatest, bool normalized) {
        using T = decltype(zero);
        GltfFile file;
        const size_t positions = file.addAccessor(squarePositions(), "VEC3");
        // Four bytes an element, as the format asks for.
        std::vector<T> uvs = {0, 0, greatest, 0, 0, greatest, greatest, T(greatest / 5)};
        const size_t view = [&] {
            const size_t stride = (2 * sizeof(T) + 3) / 4 * 4;
            std::vector<uint8_t> bytes(4 * stride);
            for (size_t i = 0; i < 4; ++i) std::memcpy(bytes.data() + i * stride, uvs.data() + 2 * i, 2 * sizeof(T));
            return file.addView(bytes, stride);
        }();
        const size_t accessor = file.add("accessors", {{"bufferView", view},
                                                       {"componentType", GltfFile::componentType(T{})},
                                                       {"count", 4},
                                                       {"type", "VEC2"},
                                                       {"normalized", normalized}});
        file.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", accessor}}}, {"mode", 5}});
        const Mesh mesh = onlyMesh(file);
        for (size_t i = 0; i < 4; ++i)
            if (mesh.positions[i] == Vec3f(1, 1, 0)) return mesh.uvs[i];
        return std::array<float, 2>{-1, -1};
    };
    EXPECT_EQ(uvsWith(uint8_t(0), uint8_t(255), true), (std::array<float, 2>{1.0f, 0.2f}));
    EXPECT_EQ(uvsWith(uint16_t(0), uint16_t(65535), true), (std::array<float, 2>{1.0f, 0.2f}));
    EXPECT_EQ(uvsWith(int16_t(0), int16_t(32767), true), (std::array<float, 2>{1.0f, 6553.0f / 32767}));
    EXPECT_EQ(uvsWith(int8_t(0), int8_t(127), true), (std::array<float, 2>{1.0f, 25.0f / 127}));
    EXPECT_EQ(uvsWith(uint8_t(0), uint8_t(3), false), (std::array<float, 2>{3.0f, 0.0f})) << "KHR_mesh_quantization";
    EXPECT_EQ(uvsWith(0.0f, 1.0f, false), (std::array<float, 2>{1.0f, 0.2f}));
}

TEST_F(GltfGeometry, SignedIntegersReachNoLessThanMinusOne) {
    GltfFile file;
    const size_t positions =
        file.addAccessor(std::vector<int16_t>{-32768, -32767, 0, 32767, 0, 0, 0, 32767, 0}, "VEC3", true);
    file.json["accessors"][positions]["bufferView"] =
        file.addView(std::vector<int16_t>{-32768, -32767, 0, 7, 32767, 0, 0, 7, 0, 32767, 0, 7}, 8);
    file.addMesh({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(onlyMesh(file).positions[0], Vec3f(-1, -1, 0));
    EXPECT_EQ(onlyMesh(file).positions[1], Vec3f(1, 0, 0)) << "a stride that skips what stands between";
}

TEST_F(GltfGeometry, InterleavedAttributes) {
    GltfFile file;
    // Position and uv of three vertices, 20 bytes each.
    const size_t view = file.addView(std::vector<float>{0, 0, 0, .1f, .2f, 1, 0, 0, .3f, .4f, 0, 1, 0, .5f, .6f}, 20);
    const size_t positions =
        file.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    const size_t uvs =
        file.add("accessors",
                 {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
    file.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}});
    const Mesh mesh = onlyMesh(file);
    EXPECT_EQ(mesh.positions[2], Vec3f(0, 1, 0));
    EXPECT_EQ(mesh.uvs[1], (std::array<float, 2>{.3f, .4f}));
    file.json["accessors"][uvs]["byteOffset"] = 16;
    EXPECT_NE(inputErrorOf([&] { import(file); }).find("accessor 1"), std::string::npos) << "4 bytes too far";
}

TEST_F(GltfGeometry, SparseElementsReplaceOthersOrZeros) {
    for (const bool withView : {true, false}) {
        GltfFile file;
        const size_t positions = file.addAccessor(std::vector<float>(9, 0.0f), "VEC3");
        json& accessor = file.json["accessors"][positions];
        if (!withView) accessor.erase("bufferView");
        accessor["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", file.addView(std::vector<uint8_t>{1, 2})}, {"componentType", 5121}}},
            {"values", {{"bufferView", file.addView(std::vector<float>{5, 0, 0, 0, 7, 0})}}}};
        const json sparse = accessor["sparse"];
        file.addMesh({{"attributes", {{"POSITION", positions}}}});
        EXPECT_EQ(cornersOf(onlyMesh(file)), (std::vector<Corner>{{Vec3f(0, 0, 0), Vec3f(5, 0, 0), Vec3f(0, 7, 0)}}));
        for (const char* count : {"/sparse/count", "/count"}) {
            GltfFile broken = file;
            broken.json["accessors"][positions][json::json_pointer(count)] = count[1] == 's' ? 3 : 2;
            EXPECT_THROW(import(broken), Error) << count;
        }
    }
}

TEST_F(GltfGeometry, AnAccessorWithoutViewHoldsZeros) {
    GltfFile file;
    const size_t positions = file.addAccessor(squarePositions(), "VEC3");
    const size_t uvs = file.add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
    file.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"mode", 5}});
    for (const auto& uv : onlyMesh(file).uvs) EXPECT_EQ(uv, (std::array<float, 2>{0, 0}));
}

TEST_F(GltfGeometry, StripsAndFansFaceOneWay) {
    GltfFile strip;
    const size_t positions = strip.addAccessor(squarePositions(), "VEC3");
    // With a repeated vertex, as strips are joined: the triangle that it makes is none, and no loss.
    const size_t indices = strip.addAccessor(std::vector<uint16_t>{0, 1, 2, 3, 3}, "SCALAR");
    strip.addMesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}, {"indices", indices}});
    GltfFile fan = strip;
    fan.json["meshes"][0]["primitives"][0]["mode"] = 6;
    fan.json["meshes"][0]["primitives"][0]["indices"] = fan.addAccessor(std::vector<uint8_t>{0, 1, 3, 2}, "SCALAR");
    for (const GltfFile& file : {strip, fan}) {
        const Scene scene = import(file);
        const auto corners = cornersOf(scene.meshes.at(0));
        ASSERT_EQ(corners.size(), 2u);
        for (const Corner& c : corners) EXPECT_EQ(normalOf(c), Vec3f(0, 0, 1));
        EXPECT_DOUBLE_EQ(areaOf(scene.meshes[0]), 1);
        for (const std::string& notice : scene.notices) EXPECT_EQ(notice.find("dropped"), std::string::npos) << notice;
    }
}

TEST_F(GltfGeometry, IndicesOfEveryWidthOrNone) {
    const auto with = [&](auto indices) {
        GltfFile file;
        const size_t positions = file.addAccessor(squarePositions(), "VEC3");
        const size_t accessor = file.addAccessor(indices, "SCALAR");
        file.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", accessor}});
        return cornersOf(onlyMesh(file));
    };
    const std::vector<Corner> expected = {{Vec3f(1, 0, 0), Vec3f(1, 1, 0), Vec3f(0, 1, 0)}};
    EXPECT_EQ(with(std::vector<uint8_t>{1, 3, 2}), expected);
    EXPECT_EQ(with(std::vector<uint16_t>{1, 3, 2}), expected);
    EXPECT_EQ(with(std::vector<uint32_t>{1, 3, 2}), expected);
    EXPECT_THROW(with(std::vector<float>{1, 3, 2}), Error);
    GltfFile file;
    const size_t positions = file.addAccessor(std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    file.addMesh({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(cornersOf(onlyMesh(file)), expected);
}

TEST_F(GltfGeometry, WhatIsNoTriangleIsCountedOnce) {
    GltfFile file;
    const size_t positions = file.addAccessor(squarePositions(), "VEC3");
    const json attributes = {{"POSITION", positions}};
    file.add("meshes", {{"primitives", json::array()}});
    for (int mode : {0, 1, 2, 3, 5})  // 4 points, 2 lines, 4 of a loop, 3 of a strip
        file.json["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"mode", mode}});
    file.json["meshes"][0]["primitives"].push_back({{"attributes", json::object()}});
    file.add("nodes", {{"mesh", 0}});
    const Scene scene = import(file);
    EXPECT_EQ(scene.meshes.size(), 1u);
    const auto count = [&](const std::string& words) {
        return std::count_if(scene.notices.begin(), scene.notices.end(),
                             [&](const std::string& n) { return n.find(words) != std::string::npos; });
    };
    EXPECT_EQ(count("13 points and lines were dropped"), 1);
    EXPECT_EQ(count("without positions"), 1);
    file.json["meshes"][0]["primitives"][0]["mode"] = 7;
    EXPECT_THROW(import(file), Error);
}

TEST_F(GltfGeometry, NodesCarryScaleThenRotationThenTranslation) {
    GltfFile file;
    const size_t positions = file.addAccessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    const size_t node = file.addMesh({{"attributes", {{"POSITION", positions}}}});
    // A quarter turn about z, of a quaternion that is not quite of unit length.
    file.json["nodes"][node].update(
        {{"scale", {2, 3, 4}}, {"rotation", {0, 0, 1.5, 1.5}}, {"translation", {10, 0, 0}}});
    const Mesh placed = onlyMesh(file);
    const std::vector<Vec3f> expected = {{10, 2, 0}, {7, 0, 0}, {10, 0, 4}};
    for (size_t i = 0; i < 3; ++i) EXPECT_LT(length(placed.positions[i] - expected[i]), 1e-6f) << i;

    file.json["nodes"][node] = {{"mesh", 0}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 0, 0, 1}}};
    EXPECT_EQ(onlyMesh(file).positions, expected);
}

TEST_F(GltfGeometry, OneOfSeveralScenesIsShown) {
    GltfFile file;
    const size_t positions = file.addAccessor(squarePositions(), "VEC3");
    file.addMesh({{"attributes", {{"POSITION", positions}}}, {"mode", 5}});
    file.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
    EXPECT_EQ(import(file).meshes.size(), 2u) << "without scenes all nodes";
    file.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    EXPECT_EQ(onlyMesh(file).positions[0].x, 0);
    file.json["scene"] = 1;
    EXPECT_EQ(onlyMesh(file).positions[0].x, 5);
    file.json["scene"] = 2;
    EXPECT_THROW(import(file), Error);
}

TEST_F(GltfGeometry, EveryTextureHasItsOwnTextureCoordinates) {
    const std::vector<uint8_t> png = testing::makePng();
    GltfFile file;
    const size_t positions = file.addAccessor(squarePositions(), "VEC3");
    const size_t first = file.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    const size_t second = file.addAccessor(std::vector<float>{.5f, 0, .5f, 0, .5f, 0, .5f, 0}, "VEC2");
    file.add("images", {{"bufferView", file.addView(png)}, {"mimeType", "image/png"}});
    file.add("samplers", {{"magFilter", 9728}});
    file.add("textures", {{"source", 0}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    const json transform = {{"KHR_texture_transform", {{"offset", {0.25, 0}}, {"scale", {2, 3}}}}};
    const json quarterTurn = {{"KHR_texture_transform", {{"rotation", 1.5707963267948966}, {"texCoord", 0}}}};
    const json identity = {{"KHR_texture_transform", {{"texCoord", 0}}}};
    file.add("materials", {{"pbrMetallicRoughness",
                            {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}},
                             {"metallicRoughnessTexture", {{"index", 1}, {"extensions", transform}}}}},
                           {"emissiveTexture", {{"index", 0}, {"texCoord", 1}, {"extensions", quarterTurn}}},
                           {"emissiveFactor", {1, 1, 1}},
                           {"normalTexture", {{"index", 0}, {"texCoord", 0}, {"extensions", identity}}}});
    file.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}}},
                  {"mode", 5},
                  {"material", 0}});
    const Scene scene = import(file);
    const Mesh& mesh = scene.meshes.at(0);
    const Material& m = scene.materials.at(0);
    size_t corner = 0;  // uv (1, 1) of the file
    while (mesh.positions.at(corner) != Vec3f(1, 1, 0)) ++corner;
    const auto uvOf = [&](TextureIndex texture) {
        const uint32_t set = scene.textures.at(texture.value()).uvSet;
        return set == 0 ? mesh.uvs[corner] : mesh.moreUvs.at((set - 1) * mesh.positions.size() + corner);
    };
    EXPECT_EQ(uvOf(m.baseColorTexture), (std::array<float, 2>{.5f, 0}));
    EXPECT_EQ(uvOf(m.metallicRoughnessTexture), (std::array<float, 2>{2.25f, 3}));
    EXPECT_NEAR(uvOf(m.emissionTexture)[0], 1, 1e-6) << "counter-clockwise, seen with v downwards: (v, -u)";
    EXPECT_NEAR(uvOf(m.emissionTexture)[1], -1, 1e-6);
    EXPECT_EQ(uvOf(m.normalTexture), (std::array<float, 2>{1, 1}));
    EXPECT_EQ(mesh.moreUvs.size(), 3 * mesh.positions.size());
    EXPECT_FALSE(scene.textures[*m.baseColorTexture].nearest);
    EXPECT_TRUE(scene.textures[*m.metallicRoughnessTexture].nearest);
    for (const std::string& notice : scene.notices) {
        EXPECT_EQ(notice.find("texture"), std::string::npos) << notice;
        EXPECT_EQ(notice.find("KHR_"), std::string::npos) << notice;
    }
    file.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_1");
    const Scene without = import(file);
    EXPECT_TRUE(std::any_of(without.notices.begin(), without.notices.end(), [](const std::string& n) {
        return n.find("'m' lacks texture coordinates") != std::string::npos;
    }));
}

/// The example of KHR_texture_transform: "only the lower left quadrant of the source image, rotated clockwise 90°". The
/// quadrant's corners therefore come round by one: the surface's upper left, uv (0, 0), shows the quadrant's lower
/// left.
TEST_F(GltfGeometry, TextureTransformsTurnAsTheExtensionsExample) {
    GltfFile file;
    const size_t positions = file.addAccessor(squarePositions(), "VEC3");
    const size_t uvs = file.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    file.add("images", {{"bufferView", file.addView(testing::makePng())}, {"mimeType", "image/png"}});
    file.add("textures", {{"source", 0}});
    const json transform = {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
    const json extension = {{"KHR_texture_transform", transform}};
    file.add("materials",
             {{"emissiveTexture", {{"index", 0}, {"extensions", extension}}}, {"emissiveFactor", {1, 1, 1}}});
    file.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"mode", 5}, {"material", 0}});
    const Mesh mesh = onlyMesh(file);
    const std::map<std::pair<float, float>, std::pair<float, float>> shown = {
        {{0, 0}, {0, 1}}, {{1, 0}, {0, .5f}}, {{0, 1}, {.5f, 1}}, {{1, 1}, {.5f, .5f}}};
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (size_t i = 0; i < mesh.uvs.size(); ++i) {
        const auto [u, v] = shown.at({mesh.positions[i].x, mesh.positions[i].y});
        EXPECT_NEAR(mesh.uvs[i][0], u, 1e-6);
        EXPECT_NEAR(mesh.uvs[i][1], v, 1e-6);
    }
}

TEST_F(GltfGeometry, VertexColorsAndTangents) {
    GltfFile file;
    const size_t positions = file.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const size_t normals = file.addAccessor(std::vector<float>{0, .6f, .8f, 0, 0, 1, 0, 0, 1}, "VEC3");
    const size_t tangents = file.addAccessor(std::vector<float>{1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, "VEC4");
    const size_t bytes = file.addAccessor(std::vector<uint8_t>{255, 51, 0, 102, 255, 51, 0, 102, 0, 0, 0, 0}, "VEC4");
    const size_t floats = file.addAccessor(std::vector<float>{.5f, 2, 0, .5f, 2, 0, .5f, 2, 0}, "VEC3");
    const size_t white = file.addAccessor(std::vector<uint16_t>(12, 65535), "VEC4", true);
    file.add("materials", json::object());
    file.addMesh(
        {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TANGENT", tangents}}}, {"material", 0}});
    json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    EXPECT_TRUE(onlyMesh(file).tangents.empty()) << "nothing asks for them";
    EXPECT_TRUE(onlyMesh(file).colors.empty());
    attributes["COLOR_0"] = bytes;
    EXPECT_EQ(onlyMesh(file).colors[0], (std::array<float, 4>{1, 0.2f, 0, 0.4f}));
    attributes["COLOR_0"] = floats;
    const Scene clamped = import(file);
    EXPECT_EQ(clamped.meshes[0].colors[0], (std::array<float, 4>{0.5f, 1, 0, 1}));
    EXPECT_EQ(std::count_if(clamped.notices.begin(), clamped.notices.end(),
                            [](const std::string& n) { return n.find("outside [0,1]") != std::string::npos; }),
              1);
    attributes["COLOR_0"] = white;
    EXPECT_TRUE(onlyMesh(file).colors.empty()) << "white changes nothing";

    file.add("images", {{"bufferView", file.addView(testing::makePng())}, {"mimeType", "image/png"}});
    file.add("textures", {{"source", 0}});
    file.json["materials"][0]["normalTexture"] = {{"index", 0}};
    EXPECT_EQ(onlyMesh(file).tangents[0], (std::array<float, 4>{1, 0, 0, -1}));
    file.json["nodes"][0]["scale"] = {2, 1, -1};
    EXPECT_EQ(onlyMesh(file).tangents[0], (std::array<float, 4>{1, 0, 0, 1})) << "a mirror turns the side over";
}

TEST_F(GltfGeometry, OrthographicCamera) {
    GltfFile file;
    file.addMesh({{"attributes", {{"POSITION", file.addAccessor(squarePositions(), "VEC3")}}}, {"mode", 5}});
    file.add("cameras",
             {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 1.5}, {"znear", 0}, {"zfar", 9}}}});
    file.add("nodes", {{"camera", 0}, {"translation", {0, 0, 5}}});
    const Scene scene = import(file);
    EXPECT_EQ(scene.camera.orthographicHeight, 3);
    EXPECT_EQ(scene.imageWidth, 2 * scene.imageHeight);
    EXPECT_EQ(scene.camera.position, Vec3f(0, 0, 5));
    file.json["cameras"][0]["orthographic"]["ymag"] = 0;
    EXPECT_THROW(import(file), Error);
}

/// A square of two triangles as Draco, positions quantised to 14 bits.
std::vector<uint8_t> dracoSquare() {
    ::draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(::draco::GeometryAttribute::POSITION, 3, ::draco::DT_FLOAT32);
    const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    builder.SetAttributeValuesForFace(position, ::draco::FaceIndex(0), p[0], p[1], p[2]);
    builder.SetAttributeValuesForFace(position, ::draco::FaceIndex(1), p[0], p[2], p[3]);
    const auto mesh = builder.Finalize();
    ::draco::Encoder encoder;
    encoder.SetAttributeQuantization(::draco::GeometryAttribute::POSITION, 14);
    ::draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

GltfFile dracoFile(const std::vector<uint8_t>& data, int indexType) {
    GltfFile file;
    const size_t view = file.addView(data);
    file.add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    file.add("accessors", {{"componentType", indexType}, {"count", 6}, {"type", "SCALAR"}});
    file.addMesh(
        {{"attributes", {{"POSITION", 0}}},
         {"indices", 1},
         {"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
    file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

TEST_F(GltfGeometry, Draco) {
    for (int indexType : {5121, 5123, 5125}) {
        const Mesh mesh = onlyMesh(dracoFile(dracoSquare(), indexType));
        EXPECT_EQ(mesh.triangles.size(), 2u);
        EXPECT_NEAR(areaOf(mesh), 1, 1e-3);
        for (const Corner& c : cornersOf(mesh)) EXPECT_GT(normalOf(c).z, 0);
    }
    GltfFile missing = dracoFile(dracoSquare(), 5123);
    missing.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["NORMAL"] = 7;
    EXPECT_NE(inputErrorOf([&] { import(missing); }).find("NORMAL"), std::string::npos);
    EXPECT_NE(inputErrorOf([&] { import(dracoFile({1, 2, 3, 4}, 5123)); }).find("Draco"), std::string::npos);
}

TEST_F(GltfGeometry, DamagedDracoIsASceneOrASentence) {
    const std::vector<uint8_t> sound = dracoSquare();
    size_t refused = 0;
    for (size_t size = 1; size < sound.size(); ++size)
        EXPECT_NE(inputErrorOf([&] {
                      import(dracoFile({sound.begin(), sound.begin() + std::ptrdiff_t(size)}, 5123));
                  }).find("m.glb"),
                  std::string::npos)
            << "cut to " << size << " bytes";
    for (size_t at = 0; at < sound.size(); ++at)
        for (const uint8_t flip : {0x01, 0x10, 0x80, 0xff}) {
            std::vector<uint8_t> damaged = sound;
            damaged[at] ^= flip;
            try {
                import(dracoFile(damaged, 5123));
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::Input) << "byte " << at;
                ++refused;
            }
        }
    EXPECT_GT(refused, sound.size()) << "damage was seen";
}

TEST_F(GltfGeometry, VariantsShowTheFirstLook) {
    GltfFile file;
    file.addMesh({{"attributes", {{"POSITION", file.addAccessor(squarePositions(), "VEC3")}}}, {"mode", 5}});
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_materials_variants"};
    const Scene scene = import(file);
    const auto said = [](const std::string& n) { return n.find("variants") != n.npos; };
    EXPECT_EQ(std::count_if(scene.notices.begin(), scene.notices.end(), said), 1);
}

TEST_F(GltfGeometry, PicturesThatNobodyDecodesAreACheckerEvenWhereRequired) {
    GltfFile file;
    file.json["images"] = {{{"uri", "a.ktx2"}, {"mimeType", "image/ktx2"}}};
    file.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_texture_basisu"};
    file.addMesh({{"attributes",
                   {{"POSITION", file.addAccessor(squarePositions(), "VEC3")},
                    {"TEXCOORD_0", file.addAccessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2")}}},
                  {"mode", 5},
                  {"material", 0}});
    EXPECT_EQ(import(file).textures.at(0).width, 8u);
}

}  // namespace
}  // namespace antipode
