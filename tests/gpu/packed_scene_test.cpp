// What the packed scene says about lights, fronts and holes, without a device.
#include "gpu/packed_scene.h"

#include <bit>
#include <cstring>
#include <ctime>

#include <gtest/gtest.h>

namespace antipode {
namespace {

using namespace shared;

/// One square of unit size per material; uvs in [0,1]².
Scene squares(std::vector<Material> materials) {
    Scene scene;
    scene.materials = std::move(materials);
    for (uint32_t m = 0; m < scene.materials.size(); ++m) {
        Mesh mesh;
        const float z = float(m);
        mesh.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
        mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        mesh.material = m;
        scene.meshes.push_back(mesh);
    }
    return scene;
}

Material lamp(float radiance) {
    Material m;
    m.emission = Vec3f(radiance);
    return m;
}

/// As many rows as columns, all of the given texels.
uint32_t addTexture(Scene& scene, std::vector<std::array<uint8_t, 4>> texels) {
    Texture t;
    t.width = t.height = uint32_t(texels.size());
    t.srgb = false;
    t.wrapU = t.wrapV = WrapMode::Clamp;
    for (uint32_t row = 0; row < t.height; ++row)
        for (const auto& texel : texels) t.rgba.insert(t.rgba.end(), texel.begin(), texel.end());
    scene.textures.push_back(t);
    return uint32_t(scene.textures.size() - 1);
}

PackedScene pack(const Scene& scene) { return packScene(scene); }

template <class T>
std::vector<uint8_t> bytesOf(const std::vector<T>& v) {
    std::vector<uint8_t> bytes(v.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), v.data(), bytes.size());
    return bytes;
}

void expectSame(const PackedScene& a, const PackedScene& b) {
    EXPECT_EQ(a.features, b.features);
    EXPECT_EQ(a.lobes, b.lobes);
    EXPECT_EQ(bytesOf(a.primitives), bytesOf(b.primitives));
    EXPECT_EQ(bytesOf(a.attributes), bytesOf(b.attributes));
    EXPECT_EQ(bytesOf(a.lights), bytesOf(b.lights));
}

/// Chance of drawing a light of that material, over all of its primitives.
double pickOf(const PackedScene& packed, uint32_t material) {
    double pick = 0;
    for (size_t i = 0; i < packed.lights.size(); i += LIGHT_TEXELS)
        if (packed.lights[i].z == material) pick += double(std::bit_cast<float>(packed.lights[i].w));
    return pick;
}

// --- How often an emitter is drawn ---

TEST(PackedLights, TrianglesAreDrawnByTheTexelsThatTheyShow) {
    Scene scene = squares({lamp(1), lamp(1)});
    // 256 texels, red on the left quarter: the lower right triangle of the square shows less of it than the upper left.
    std::vector<std::array<uint8_t, 4>> texels(256, {0, 0, 0, 255});
    for (size_t i = 0; i < 64; ++i) texels[i] = {255, 0, 0, 255};
    scene.materials[0].emissionTexture = addTexture(scene, texels);
    const PackedScene packed = pack(scene);
    ASSERT_EQ(packed.lightCount, 4u);
    // A quarter of the area in one of three channels, beside a square in all of them.
    EXPECT_NEAR(pickOf(packed, 0) / pickOf(packed, 1), 0.25 / 3, 0.01);
    std::vector<double> halves;
    for (size_t i = 0; i < packed.lights.size(); i += LIGHT_TEXELS)
        if (packed.lights[i].z == 0) halves.push_back(double(std::bit_cast<float>(packed.lights[i].w)));
    ASSERT_EQ(halves.size(), 2u);
    // Areas right and left of the diagonal: 1/32 and 7/32.
    EXPECT_NEAR(std::max(halves[0], halves[1]) / std::min(halves[0], halves[1]), 7, 1);
}

TEST(PackedLights, BlackTexelsAreNoLight) {
    Scene scene = squares({lamp(1), lamp(1)});
    std::vector<std::array<uint8_t, 4>> texels(64, {0, 0, 0, 255});
    texels[63] = {1, 0, 0, 255};
    scene.materials[0].emissionTexture = addTexture(scene, texels);
    scene.meshes[0].uvs = {{0, 0}, {0.5f, 0}, {0.5f, 1}, {1, 1}};  // the second triangle alone reaches the last texel
    const PackedScene packed = pack(scene);
    ASSERT_EQ(packed.lightCount, 3u);
    EXPECT_GT(pickOf(packed, 0), 0.0);
    EXPECT_LT(pickOf(packed, 0), 1e-3);
}

TEST(PackedLights, HolesTakeFromTheChance) {
    Scene scene = squares({lamp(1), lamp(1)});
    std::vector<std::array<uint8_t, 4>> texels(64, {255, 255, 255, 255});
    for (size_t i = 0; i < 48; ++i) texels[i][3] = 100;
    scene.materials[0].baseColorTexture = addTexture(scene, texels);
    scene.materials[0].alphaCutoff = 0.5f;
    EXPECT_NEAR(pickOf(pack(scene), 0) / pickOf(pack(scene), 1), 0.25, 0.02);
    scene.materials[0].alphaCutoff = 0.2f;
    EXPECT_NEAR(pickOf(pack(scene), 0), 0.5, 1e-6);
}

/// 20,000 triangles that show all of a million texels each: a mean a triangle would read 2·10^10 texels.
TEST(PackedLights, TakeTimeInProportionToTexelsAndTriangles) {
    Scene scene = squares({lamp(1)});
    Texture t;
    t.width = t.height = 1024;
    t.rgba.assign(4u << 20, 128);
    scene.textures.push_back(t);
    scene.materials[0].emissionTexture = 0;
    scene.meshes[0].triangles.assign(20000, {0, 1, 2});
    const std::clock_t start = std::clock();
    EXPECT_EQ(pack(scene).lightCount, 20000u);
    EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 5.0);
}

/// What the callback throws goes through, from whichever part it is thrown.
TEST(PackedLights, EveryPartOfThePackingCanBeInterrupted) {
    Scene scene = squares({lamp(1)});
    scene.materials[0].emissionTexture = addTexture(scene, {{255, 255, 255, 255}});
    std::vector<std::string> parts;
    packScene(scene, [&](const char* next) { parts.push_back(next); });
    ASSERT_EQ(parts.size(), 4u);
    for (const std::string& part : parts)
        EXPECT_THROW(packScene(scene,
                               [&](const char* next) {
                                   if (part == next) throw part;
                               }),
                     std::string)
            << part;
}

// --- Fronts ---

TEST(PackedFronts, FollowTheVertexNormals) {
    Scene wanted = squares({lamp(1)}), wound = wanted;
    for (Scene* s : {&wanted, &wound}) s->meshes[0].normals.assign(4, Vec3f{0, 0, 1});
    for (auto& t : wound.meshes[0].triangles) std::swap(t[1], t[2]);
    expectSame(pack(wound), pack(wanted));
}

TEST(PackedFronts, StayWhereNormalsAgreeOrAreNot) {
    Scene agreeing = squares({lamp(1)}), without = agreeing;
    agreeing.meshes[0].normals.assign(4, Vec3f{0.6f, 0, 0.8f});
    EXPECT_EQ(bytesOf(pack(agreeing).primitives), bytesOf(pack(without).primitives));
    for (auto& t : without.meshes[0].triangles) std::swap(t[1], t[2]);
    EXPECT_NE(bytesOf(pack(agreeing).primitives), bytesOf(pack(without).primitives));
}

/// Each triangle by the sum of its own normals: the majority of one that disagrees with itself.
TEST(PackedFronts, AreDecidedTriangleByTriangle) {
    Scene scene = squares({lamp(1)}), wanted = scene;
    for (Scene* s : {&scene, &wanted}) {
        s->meshes[0].positions.push_back({0, 0, 0});
        s->meshes[0].uvs.push_back({0, 0});
        s->meshes[0].normals = {{0, 0, -1}, {0, 0, 1}, {0, 0, 1}, {0, 0, -1}, {0, 0, -1}};
    }
    scene.meshes[0].triangles = {{0, 1, 2}, {4, 2, 3}};
    wanted.meshes[0].triangles = {{0, 1, 2}, {4, 3, 2}};
    expectSame(pack(scene), pack(wanted));
}

// --- Holes ---

TEST(PackedHoles, WhatNoAlphaReachesIsNotThere) {
    Material gone = lamp(1), here = lamp(1);
    gone.alphaCutoff = 1.5f;
    here.alphaCutoff = 0.5f;
    Scene scene = squares({gone, here}), wanted = squares({lamp(1), lamp(1)});
    scene.spheres.push_back({{0, 0, 5}, 1, 0});
    wanted.meshes.erase(wanted.meshes.begin());
    const PackedScene packed = pack(scene);
    expectSame(packed, pack(wanted));
    EXPECT_EQ(packed.features & (FEATURE_ALPHA | FEATURE_SPHERES), 0u);
}

TEST(PackedHoles, CutOffsThatEveryAlphaReachesCostNothing) {
    Scene scene = squares({lamp(1)});
    scene.materials[0].baseColorTexture = addTexture(scene, {{255, 255, 255, 0}});
    scene.materials[0].alphaCutoff = 0.0f;
    EXPECT_EQ(pack(scene).features & FEATURE_ALPHA, 0u);
    scene.materials[0].alphaCutoff = 0.01f;
    EXPECT_NE(pack(scene).features & FEATURE_ALPHA, 0u);
}

/// Behind the records of all materials, and nothing of them where no material has any.
TEST(PackedLayers, LieWhereTheirMaterialSays) {
    Material plain = lamp(1), coated = lamp(1);
    plain.kind = coated.kind = MaterialKind::MetallicRoughness;
    coated.clearcoat = 0.5f;
    coated.sheenColor = {0.1f, 0.2f, 0.3f};
    const PackedScene without = pack(squares({plain, plain, plain})), with = pack(squares({plain, coated, coated}));
    EXPECT_EQ(without.materials.size(), 3 * MATERIAL_TEXELS);
    EXPECT_TRUE(without.losses.empty());
    EXPECT_EQ(without.lobes, with.lobes & ~(LOBE_CLEARCOAT | LOBE_SHEEN));
    ASSERT_EQ(with.materials.size(), 3 * MATERIAL_TEXELS + 2 * LAYERS_TEXELS);
    EXPECT_EQ(with.materials[5].z, 0u);
    for (uint32_t i : {1u, 2u}) {
        const uint32_t layers = with.materials[i * MATERIAL_TEXELS + 5].z;
        ASSERT_EQ(layers, 3 * MATERIAL_TEXELS + (i - 1) * LAYERS_TEXELS);
        EXPECT_EQ(std::bit_cast<float>(with.materials[layers].x), 0.5f);
        EXPECT_EQ(std::bit_cast<float>(with.materials[layers + 1].z), 0.3f);
        EXPECT_EQ(with.materials[layers + 2].x, NO_INDEX);
    }

    coated.transmission = 1;  // glass alone has no layers
    EXPECT_EQ(pack(squares({coated})).lobes & (LOBE_CLEARCOAT | LOBE_SHEEN), 0u);
}

}  // namespace
}  // namespace antipode
