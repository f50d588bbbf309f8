// What moves, copies and compresses the meshes of glTF 2.0: morph targets, skins, animations, instances, meshopt.
#include <meshoptimizer.h>
#include <webp/encode.h>

#include <cmath>

#include "renderengine/import_options.h"
#include "scene/image_decode.h"
#include "scene/webp_decode.h"
#include "tests/scene/gltf_files.h"

namespace antipode {
namespace {

using nlohmann::json;
using testing::GltfFile;
using testing::inputErrorOf;
using testing::squarePositions;

class GltfPoses : public testing::ModelFiles {
protected:
    Scene import(const GltfFile& file, std::optional<double> time = {}) {
        ImportOptions options;
        options.animationTime = time;
        return importModel(write("m.glb", file.glb()), options);
    }
    /// The centre of the box of the only mesh.
    Vec3f centerOf(const GltfFile& file, std::optional<double> time = {}) {
        const Scene scene = import(file, time);
        EXPECT_EQ(scene.meshes.size(), 1u);
        Vec3f low = scene.meshes.at(0).positions.at(0), high = low;
        for (const Vec3f& p : scene.meshes[0].positions)
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], p[axis]);
                high[axis] = std::max(high[axis], p[axis]);
            }
        return (low + high) * 0.5f;
    }
    static json square(GltfFile& file) {
        return {{"attributes", {{"POSITION", file.addAccessor(squarePositions(), "VEC3")}}}, {"mode", 5}};
    }
};

void expectNear(const Vec3f& a, const Vec3f& b) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-6) << "axis " << axis;
}

TEST_F(GltfPoses, MorphTargetsAddUpByTheirWeights) {
    GltfFile file;
    json primitive = square(file);
    const std::vector<float> right = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, up = {0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 4, 0};
    primitive["targets"] = {{{"POSITION", file.addAccessor(right, "VEC3")}},
                            {{"POSITION", file.addAccessor(up, "VEC3")}}};
    const size_t node = file.addMesh(primitive);
    expectNear(centerOf(file), {0.5f, 0.5f, 0});
    file.json["meshes"][0]["weights"] = {0.5, 0.25};
    expectNear(centerOf(file), {1.0f, 1.5f, 0});
    file.json["nodes"][node]["weights"] = {0, 1};
    expectNear(centerOf(file), {0.5f, 4.5f, 0});
    primitive["targets"][0]["POSITION"] = file.addAccessor(std::vector<float>{1, 0, 0}, "VEC3");
    file.json["meshes"][0]["primitives"][0] = primitive;
    file.json["nodes"][node]["weights"] = {1, 1};
    EXPECT_NE(inputErrorOf([&] { import(file); }).find("morph target 0 has 1 values"), std::string::npos);
}

/// A square on two joints, half of each; the skin's node stands elsewhere, which must not count.
GltfFile skinnedSquare() {
    GltfFile file;
    json primitive = {
        {"attributes",
         {{"POSITION", file.addAccessor(squarePositions(), "VEC3")},
          {"JOINTS_0", file.addAccessor(std::vector<uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4")},
          {"WEIGHTS_0", file.addAccessor(std::vector<float>{1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0}, "VEC4")}}},
        {"mode", 5}};
    const size_t node = file.addMesh(primitive);
    const size_t first = file.add("nodes", {{"translation", {2, 0, 0}}}),
                 second = file.add("nodes", {{"translation", {0, 6, 0}}});
    file.json["nodes"][node]["translation"] = {100, 100, 100};
    file.json["nodes"][node]["skin"] = file.add("skins", {{"joints", {first, second}}});
    return file;
}

TEST_F(GltfPoses, SkinsMoveVerticesByTheMeanOfTheirJoints) {
    GltfFile file = skinnedSquare();
    expectNear(centerOf(file), {1.5f, 3.5f, 0});
    // The first joint was bound where it is: it moves nothing.
    const std::vector<float> matrices = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0, 0, 1,
                                         1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1};
    file.json["skins"][0]["inverseBindMatrices"] = file.addAccessor(matrices, "MAT4");
    expectNear(centerOf(file), {0.5f, 3.5f, 0});
}

TEST_F(GltfPoses, SkinsThatContradictThemselvesAreRefused) {
    GltfFile file = skinnedSquare();
    file.json["skins"][0]["inverseBindMatrices"] = file.addAccessor(std::vector<float>(16), "MAT4");
    EXPECT_NE(inputErrorOf([&] { import(file); }).find("fewer matrices than joints"), std::string::npos);
    file = skinnedSquare();
    file.json["skins"][0]["joints"].erase(1);
    EXPECT_NE(inputErrorOf([&] { import(file); }).find("a joint that its skin does not have"), std::string::npos);
    file = skinnedSquare();
    file.json["skins"][0]["joints"][1] = 77;
    EXPECT_NE(inputErrorOf([&] { import(file); }), "");
    file.json["nodes"][0]["skin"] = 3;
    EXPECT_NE(inputErrorOf([&] { import(file); }), "");
}

TEST_F(GltfPoses, AnimationsAreShownAtTheTimeThatIsAskedFor) {
    GltfFile file;
    const size_t node = file.addMesh(square(file));
    const size_t times = file.addAccessor(std::vector<float>{1, 3}, "SCALAR");
    const auto animate = [&](const char* path, const char* interpolation, const std::vector<float>& values,
                             const char* type) {
        const size_t output = file.addAccessor(values, type);
        file.json["animations"] = {
            {{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
             {"samplers", {{{"input", times}, {"output", output}, {"interpolation", interpolation}}}}}};
    };
    animate("translation", "LINEAR", {0, 0, 0, 4, 0, 0}, "VEC3");
    expectNear(centerOf(file), {0.5f, 0.5f, 0});
    EXPECT_NE(import(file).notices.size(), 0u) << "that it is shown at rest is said";
    expectNear(centerOf(file, 0), {0.5f, 0.5f, 0});
    expectNear(centerOf(file, 1.5), {1.5f, 0.5f, 0});
    expectNear(centerOf(file, 9), {4.5f, 0.5f, 0});
    animate("translation", "STEP", {0, 0, 0, 4, 0, 0}, "VEC3");
    expectNear(centerOf(file, 2.9), {0.5f, 0.5f, 0});
    // A quarter turn about z: an eighth at half the time.
    const float half = float(std::sqrt(0.5));
    animate("rotation", "LINEAR", {0, 0, 0, 1, 0, 0, half, half}, "VEC4");
    expectNear(centerOf(file, 3), {-0.5f, 0.5f, 0});
    expectNear(centerOf(file, 2), {0, half, 0});
    // A cubic of value 0, slope 0 and value 1, slope 0: 3s² − 2s³.
    animate("translation", "CUBICSPLINE", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3");
    expectNear(centerOf(file, 1.5), {0.5f + 3.0f / 16 - 2.0f / 64, 0.5f, 0});
    animate("translation", "LINEAR", {0, 0, 0, 4}, "SCALAR");
    EXPECT_NE(inputErrorOf([&] { import(file, 2.0); }), "") << "two numbers do not move a node";
}

TEST_F(GltfPoses, InstancesAreCopies) {
    GltfFile file;
    const size_t node = file.addMesh(square(file));
    const size_t to = file.addAccessor(std::vector<float>{0, 0, 0, 10, 0, 0, 0, 20, 0}, "VEC3");
    const size_t scale = file.addAccessor(std::vector<float>{1, 1, 1, 2, 2, 2, 1, 1, 1}, "VEC3");
    file.json["nodes"][node]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", to},
                                                                                       {"SCALE", scale}};
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = import(file);
    ASSERT_EQ(scene.meshes.size(), 3u);
    const auto has = [&](size_t mesh, const Vec3f& p) {
        const auto& all = scene.meshes[mesh].positions;
        return std::find(all.begin(), all.end(), p) != all.end();
    };
    EXPECT_TRUE(has(0, {1, 1, 0}));
    EXPECT_TRUE(has(1, {12, 2, 0}));
    EXPECT_TRUE(has(2, {1, 21, 0}));
    file.json["nodes"][node]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
        file.addAccessor(std::vector<float>{1, 1, 1}, "VEC3");
    EXPECT_NE(inputErrorOf([&] { import(file); }).find("attributes of different numbers"), std::string::npos);
}

TEST_F(GltfPoses, MeshoptViewsAreDecoded) {
    const std::vector<float> positions = squarePositions();
    std::vector<uint8_t> packed(meshopt_encodeVertexBufferBound(4, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), 4, 12));
    GltfFile file;
    const size_t compressed = file.addView(packed);
    const json from = file.json["bufferViews"][compressed];
    file.json["bufferViews"][compressed] = {{"buffer", 0},
                                            {"byteLength", 48},
                                            {"extensions",
                                             {{"EXT_meshopt_compression",
                                               {{"buffer", 0},
                                                {"byteOffset", from["byteOffset"]},
                                                {"byteLength", from["byteLength"]},
                                                {"byteStride", 12},
                                                {"count", 4},
                                                {"mode", "ATTRIBUTES"}}}}}};
    const size_t accessor =
        file.add("accessors", {{"bufferView", compressed}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    file.addMesh({{"attributes", {{"POSITION", accessor}}}, {"mode", 5}});
    expectNear(centerOf(file), {0.5f, 0.5f, 0});
    GltfFile ratified = file;
    json& names = ratified.json["bufferViews"][compressed]["extensions"];
    names["KHR_meshopt_compression"] = names["EXT_meshopt_compression"];
    names.erase("EXT_meshopt_compression");
    ratified.json["extensionsRequired"] = {"KHR_meshopt_compression"};
    ratified.json["bufferViews"][compressed]["buffer"] = ratified.add("buffers", {{"byteLength", 48}});  // nowhere
    expectNear(centerOf(ratified), {0.5f, 0.5f, 0});

    json& extension = file.json["bufferViews"][compressed]["extensions"]["EXT_meshopt_compression"];
    const json sound = extension;
    for (const auto& [key, value] : std::vector<std::pair<const char*, json>>{{"byteStride", 0},
                                                                              {"byteStride", 260},
                                                                              {"byteStride", 6},
                                                                              {"count", 0},
                                                                              {"count", uint64_t(1) << 61},
                                                                              {"count", 1 << 30},
                                                                              {"mode", "OTHER"},
                                                                              {"mode", "TRIANGLES"},
                                                                              {"filter", "QUATERNION"},
                                                                              {"byteLength", 7}}) {
        extension = sound;
        extension[key] = value;
        EXPECT_NE(inputErrorOf([&] { import(file); }), "") << key << " " << value;
    }
}

/// An edge where the file's blocks of colours have one, too: four red columns, then four green ones.
TEST(Webp, ColoursOfLossyFilesDoNotBleed) {
    std::vector<uint8_t> rgba;
    for (int i = 0; i < 64; ++i)
        for (const int v : {i % 8 < 4 ? 255 : 0, i % 8 < 4 ? 0 : 255, 0, 255}) rgba.push_back(uint8_t(v));
    uint8_t* encoded = nullptr;
    const size_t size = WebPEncodeRGBA(rgba.data(), 8, 8, 32, 75, &encoded);
    const std::vector<uint8_t> file(encoded, encoded + size);
    WebPFree(encoded);
    const Texture texture = decodeWebp(file, "edge.webp");
    ASSERT_EQ(texture.rgba.size(), rgba.size());
    for (size_t i = 0; i < rgba.size(); ++i) EXPECT_NEAR(texture.rgba[i], rgba[i], 8) << "pixel " << i / 4;
}

TEST(Webp, IsDecodedAndDamageIsAnError) {
    const std::vector<uint8_t> rgba = {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 0, 9, 8, 7, 255};
    uint8_t* encoded = nullptr;
    const size_t size = WebPEncodeLosslessRGBA(rgba.data(), 2, 2, 8, &encoded);
    const std::vector<uint8_t> file(encoded, encoded + size);
    WebPFree(encoded);
    ASSERT_TRUE(isWebp(file));
    const Texture texture = decodeImage(file, "w");
    EXPECT_EQ(texture.width, 2u);
    EXPECT_EQ(texture.height, 2u);
    for (size_t i : {0u, 1u, 3u})  // what is transparent has no colour to keep
        EXPECT_TRUE(
            std::equal(rgba.begin() + long(4 * i), rgba.begin() + long(4 * i + 4), texture.rgba.begin() + long(4 * i)))
            << i;
    for (size_t cut = 12; cut < file.size(); ++cut)
        EXPECT_NE(inputErrorOf([&] { decodeImage(std::span(file).first(cut), "w"); }), "") << cut;
}

}  // namespace
}  // namespace antipode
