#include "tests/scene/full_scene.h"

#include "tests/scene/model_files.h"

namespace antipode::testing {

Scene fullScene() {
    Scene s = smallScene();
    s.textures = {{"tex", 2, 1, {1, 2, 3, 4, 5, 6, 7, 8}, false, WrapMode::Clamp, WrapMode::Mirror, true, 1}};
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
    m.transmission = 0.6f;
    m.thin = true;
    m.attenuationColor = {0.9f, 0.8f, 0.7f};
    m.attenuationDistance = 0.4f;
    m.transmissionTexture = 0;
    m.normalScale = 0.25f;
    m.priority = 2;
    m.alphaCutoff = 0.6f;
    m.coverage = 0.55f;
    m.twoSided = false;
    s.materials.push_back(m);
    s.meshes[0].normals.assign(3, Vec3f(normalize(Vec3d(1, 2, 3))));
    s.meshes[0].uvs = {{0, 0}, {0.1f, 0.9f}, {1.0f / 3, 7}};
    s.meshes[0].triangles.push_back({0, 0, 1});
    s.meshes[0].moreUvs = {{0.5f, 0}, {0.2f, 0.8f}, {1.0f / 7, 3}};
    s.meshes[0].colors = {{0, 0.5f, 0.25f, 0.7f}, {0.1f, 0.2f, 0.3f, 0.4f}, {1, 0, 1, 0.5f}};
    s.meshes[0].tangents = {{1, 0, 0, 1}, {0, 1, 0, -1}, {0, 0, 1, 1}};
    s.pointLights = {{{1, 2, 3}, {4, 5, 6}}};
    s.spotLights = {{{1, 2, 3}, Vec3f(normalize(Vec3d(3, 1, 2))), {4, 5, 6}, 0.123f, 0.789f}};
    s.directionalLights = {{Vec3f(normalize(Vec3d(-1, 2, 7))), {1, 2, 3}}};
    s.environment = Environment{{1, 2, 3}, 2, 1, {{0.1f, 0.2f, 0.3f}, {4, 5, 6}}, 1.234f, true};
    s.camera = Camera{{1, 2, 3}, Vec3f(normalize(Vec3d(1, 1, -2))), {0, 0, 1}, 0.987654f, 0.05f, 3.7f, 0};
    s.imageWidth = 33;
    s.imageHeight = 17;
    s.maxPathLength = 9;
    s.notices = {"a notice"};
    return s;
}

}  // namespace antipode::testing
