#include "tests/techniques/agreement_scenes.h"

#include <cmath>

#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

/// A 4 × 4 texture whose texels count through distinct values; alpha opaque.
uint32_t addCheckedTexture(Scene& scene, bool srgb) {
    Texture texture;
    texture.width = texture.height = 4;
    texture.srgb = srgb;
    for (uint32_t i = 0; i < 16; ++i) {
        const bool dark = ((i ^ (i >> 2)) & 1) != 0;
        const auto value = [&](uint32_t step) { return uint8_t(dark ? 40 + step * i : 250 - step * i); };
        texture.rgba.insert(texture.rgba.end(), {value(4), value(6), value(2), 255});
    }
    scene.textures.push_back(texture);
    return uint32_t(scene.textures.size() - 1);
}

/// Tangent-space normals that lean by up to 30° in directions that go round with the texel.
uint32_t addNormalMap(Scene& scene) {
    Texture texture;
    texture.width = texture.height = 4;
    texture.srgb = false;
    for (uint32_t i = 0; i < 16; ++i) {
        const Vec3d n = normalize(Vec3d(0.5 * std::cos(2.0 * i), 0.5 * std::sin(2.0 * i), 1));
        const auto encode = [](double c) { return uint8_t(std::lround((0.5 * c + 0.5) * 255)); };
        texture.rgba.insert(texture.rgba.end(), {encode(n.x), encode(n.y), encode(n.z), 255});
    }
    scene.textures.push_back(texture);
    return uint32_t(scene.textures.size() - 1);
}

uint32_t addPhong(Scene& scene) {
    const uint32_t phong = addMaterial(scene, MaterialKind::Phong, {0.3f, 0.4f, 0.2f}, 1);
    scene.materials[phong].specular = Vec3f(0.4f);
    scene.materials[phong].phongExponent = 12;
    return phong;
}

/// A room open at the front and on top, 4.4 × 4 × 3.2: a textured floor, walls at the sides, and `back` behind.
void addRoom(Scene& scene, uint32_t back) {
    const uint32_t floor = addLambert(scene, Vec3f(1.0f));
    scene.materials[floor].baseColorTexture = addCheckedTexture(scene, true);
    addHorizontalSquare(scene, {0, 0, 0}, 2.1f, floor);
    addQuad(scene, {0, 2.2f, 1.65f}, {2.1f, 0, 0}, {0, 0, 1.55f}, back);
    addQuad(scene, {-2.2f, 0, 1.65f}, {0, 2.1f, 0}, {0, 0, 1.55f}, addLambert(scene, {0.8f, 0.4f, 0.5f}));
    addQuad(scene, {2.2f, 0, 1.65f}, {0, 0, 1.55f}, {0, 2.1f, 0}, addLambert(scene, {0.5f, 0.8f, 0.6f}));
    scene.camera = lookAt({0, -6, 2.2f}, {0, 0, 1.2f}, {0, 0, 1}, 0.62);
}

void addCeiling(Scene& scene) { addHorizontalSquare(scene, {0, 0, 3.4f}, 2.1f, addLambert(scene, Vec3f(0.8f)), false); }

/// A lamp of half-width .6 that faces down, and a glowing ball.
void addQuadAndBall(Scene& scene) {
    addHorizontalSquare(scene, {0, 0, 3}, 0.6f, addLamp(scene, {8, 6, 4}), false);
    scene.spheres.push_back({{1.3f, 0.8f, 2.2f}, 0.2f, addLamp(scene, {3, 6, 9})});
}

}  // namespace

Scene mattScene() {
    Scene scene;
    const uint32_t bumpy = addLambert(scene, {0.5f, 0.7f, 0.8f});
    scene.materials[bumpy].normalTexture = addNormalMap(scene);
    addRoom(scene, bumpy);
    addGeodesicSphere(scene, {0, 0.3f, 0.85f}, 0.7f, 1, true, false, addPhong(scene));
    scene.spheres.push_back(
        {{-1.4f, 0, 0.6f}, 0.5f, addMaterial(scene, MaterialKind::RoughConductor, Vec3f(1.0f), 0.6f)});
    scene.spheres.push_back(
        {{1.4f, 0, 0.6f}, 0.5f, addMaterial(scene, MaterialKind::RoughDielectric, Vec3f(1.0f), 0.6f)});
    const uint32_t plate = addMaterial(scene, MaterialKind::MetallicRoughness, {0.9f, 0.6f, 0.4f}, 0.9f);
    scene.materials[plate].metallic = 0.8f;
    scene.materials[plate].metallicRoughnessTexture = addCheckedTexture(scene, false);
    addQuad(scene, {0, -1.2f, 0.5f}, {0.6f, 0, 0}, {0, 0.3f, 0.2f}, plate);
    return scene;
}

Scene scatteredLampsScene() {
    Scene scene = mattScene();
    addCeiling(scene);
    addQuadAndBall(scene);
    addQuad(scene, {-1.9f, 0, 1.7f}, {0, 0.4f, 0}, {0, 0, 0.4f}, addLamp(scene, {6, 2, 3}, true));
    return scene;
}

Scene lampsScene() {
    Scene scene = scatteredLampsScene();
    addPointLight(scene, {-1, -1.5f, 2.5f}, {5, 8, 4});
    scene.spotLights.push_back({{2, -2, 3}, normalize(Vec3f{-2, 2, -2.5f}), {30, 20, 40}, 0.2f, 0.5f});
    return scene;
}

Scene skyScene() {
    Scene scene = mattScene();
    scene.directionalLights.push_back({normalize(Vec3f{-1, 2, -3}), {3, 2, 1}});
    Environment& sky = scene.environment.emplace();
    sky.radiance = Vec3f(0.5f);
    sky.width = 8;
    sky.height = 4;
    sky.rotation = 0.7f;
    sky.zUp = true;
    for (uint32_t i = 0; i < 32; ++i) sky.map.push_back({float(1 + i % 3), float(1 + i % 5), i == 11 ? 20.0f : 1.0f});
    scene.camera.lensRadius = 0.15f;
    scene.camera.focusDistance = 6;
    return scene;
}

Scene glassScene() {
    Scene scene;
    addRoom(scene, addLambert(scene, {0.5f, 0.7f, 0.8f}));
    addCeiling(scene);
    addQuadAndBall(scene);
    const auto addShare = [&](float roughness, float transmission, Vec3f color) {
        const uint32_t m = addMaterial(scene, MaterialKind::MetallicRoughness, color, roughness);
        scene.materials[m].transmission = transmission;
        return m;
    };
    scene.spheres.push_back({{-1.3f, 0.4f, 0.6f}, 0.5f, addShare(0, 0.5f, {0.9f, 0.6f, 0.4f})});
    scene.spheres.push_back({{0, 0.9f, 0.7f}, 0.5f, addShare(0.6f, 0.6f, {0.5f, 0.8f, 0.9f})});
    const uint32_t bottle = addGlass(scene);
    scene.materials[bottle].attenuationColor = {0.3f, 0.8f, 0.5f};
    scene.materials[bottle].attenuationDistance = 0.6f;
    scene.spheres.push_back({{1.2f, 0, 0.6f}, 0.5f, bottle});
    const uint32_t clear = addGlass(scene), frosted = addShare(0.5f, 1, {0.9f, 0.7f, 0.5f});
    scene.materials[clear].thin = scene.materials[frosted].thin = true;
    addQuad(scene, {-0.6f, -1.2f, 0.8f}, {0.4f, 0.1f, 0}, {0, 0, 0.5f}, clear);
    addQuad(scene, {0.6f, -1.2f, 0.8f}, {0.4f, -0.1f, 0}, {0, 0, 0.5f}, frosted);
    setConstantSky(scene, {0.2f, 0.4f, 0.6f});
    return scene;
}

Scene mediaScene() {
    Scene scene;
    addRoom(scene, addLambert(scene, {0.5f, 0.7f, 0.8f}));
    addCeiling(scene);
    addQuadAndBall(scene);
    const auto addFilled = [&](Vec3f center, float radius, float ior, Vec3f color, float distance, float anisotropy) {
        const uint32_t m = addGlass(scene, ior);
        scene.materials[m].scatteringColor = color;
        scene.materials[m].scatteringDistance = distance;
        scene.materials[m].scatteringAnisotropy = anisotropy;
        scene.spheres.push_back({center, radius, m});
        return m;
    };
    const uint32_t fog = addFilled({0, 0, 1}, 9, 1, {1, 0.7f, 0.5f}, 6, 0.5f);
    scene.materials[fog].attenuationColor = {0.9f, 1, 0.8f};
    scene.materials[fog].attenuationDistance = 5.0f;
    addFilled({-0.9f, -0.3f, 0.7f}, 0.6f, 1.4f, {0.6f, 0.9f, 1}, 0.4f, -0.3f);
    addFilled({0.9f, -0.3f, 0.7f}, 0.6f, 1, {1, 1, 1}, 0.5f, 0.8f);
    return scene;
}

Scene dispersiveScene() {
    Scene scene;
    addRoom(scene, addLambert(scene, {0.5f, 0.7f, 0.8f}));
    addCeiling(scene);
    addQuadAndBall(scene);
    const uint32_t clear = addGlass(scene, 1.6f), frosted = addMaterial(scene, MaterialKind::RoughDielectric, {}, 0.5f);
    for (const uint32_t m : {clear, frosted}) scene.materials[m].abbeNumber = 12;
    scene.spheres.push_back({{-1.3f, 0.4f, 0.6f}, 0.5f, clear});
    scene.spheres.push_back({{-1.3f, 0.4f, 0.6f}, 0.2f, addGlass(scene, 1.33f)});
    scene.spheres.push_back({{0, 0.9f, 0.7f}, 0.5f, frosted});
    setConstantSky(scene, {0.2f, 0.4f, 0.6f});
    return scene;
}

Scene layeredScene() {
    Scene scene;
    addRoom(scene, addLambert(scene, {0.5f, 0.7f, 0.8f}));
    addCeiling(scene);
    addQuadAndBall(scene);
    const auto addLayered = [&](float metallic, float coat, float coatRoughness, Vec3f sheen, float sheenRoughness) {
        const uint32_t m = addMaterial(scene, MaterialKind::MetallicRoughness, {0.8f, 0.5f, 0.3f}, 0.7f);
        scene.materials[m].metallic = metallic;
        scene.materials[m].clearcoat = coat;
        scene.materials[m].clearcoatRoughness = coatRoughness;
        scene.materials[m].sheenColor = sheen;
        scene.materials[m].sheenRoughness = sheenRoughness;
        return m;
    };
    scene.spheres.push_back({{-1.3f, 0.4f, 0.6f}, 0.5f, addLayered(0.8f, 1, 0.4f, Vec3f(0.0f), 0)});
    scene.spheres.push_back({{0, 0.9f, 0.7f}, 0.5f, addLayered(0, 0, 0, {0.5f, 0.8f, 0.9f}, 0.4f)});
    scene.spheres.push_back({{1.2f, 0, 0.6f}, 0.5f, addLayered(0.3f, 0.6f, 0.6f, {0.9f, 0.6f, 0.4f}, 0.7f)});
    const uint32_t plate = addLayered(0, 1, 1, Vec3f(1.0f), 1);
    scene.materials[plate].clearcoatTexture = scene.materials[plate].clearcoatRoughnessTexture =
        addCheckedTexture(scene, false);
    scene.materials[plate].sheenColorTexture = addCheckedTexture(scene, true);
    addQuad(scene, {0, -1.2f, 0.5f}, {0.6f, 0, 0}, {0, 0.3f, 0.2f}, plate);
    setConstantSky(scene, {0.2f, 0.4f, 0.6f});
    return scene;
}

Scene blendedScene() {
    Scene scene;
    const uint32_t back = addLambert(scene, {0.5f, 0.7f, 0.8f});
    scene.materials[back].coverage = 0.5f;
    addRoom(scene, back);
    addCeiling(scene);
    addQuadAndBall(scene);
    const uint32_t lamp = addLamp(scene, {6, 2, 3}, true), ball = addLambert(scene, {0.9f, 0.5f, 0.3f}),
                   sheet = addLambert(scene, Vec3f(0.9f));
    scene.materials[lamp].coverage = 0.6f;
    scene.materials[ball].coverage = 0.4f;
    scene.materials[sheet].baseColorTexture = addCheckedTexture(scene, true);
    for (size_t i = 0; i < 16; ++i) scene.textures.back().rgba[4 * i + 3] = uint8_t(40 + 14 * i);
    scene.materials[sheet].coverage = 0.9f;
    addQuad(scene, {-1.9f, 0, 1.7f}, {0, 0.4f, 0}, {0, 0, 0.4f}, lamp);
    scene.spheres.push_back({{1.1f, 0, 0.7f}, 0.5f, ball});
    addQuad(scene, {-0.4f, -0.5f, 0.8f}, {0.7f, 0.1f, 0}, {0, 0, 0.6f}, sheet);
    setConstantSky(scene, {0.2f, 0.4f, 0.6f});
    return scene;
}

Scene specularScene() {
    Scene scene;
    addRoom(scene, addLambert(scene, {0.5f, 0.7f, 0.8f}));
    addCeiling(scene);
    addQuadAndBall(scene);
    addGeodesicSphere(scene, {0, 0.8f, 0.85f}, 0.7f, 1, true, false, addPhong(scene));
    scene.spheres.push_back({{-1.3f, 0, 0.6f}, 0.5f, addMirror(scene, 0.9f)});
    scene.spheres.push_back({{1.2f, -0.2f, 0.6f}, 0.5f, addGlass(scene)});
    setConstantSky(scene, {0.2f, 0.4f, 0.6f});
    return scene;
}

}  // namespace antipode::test
