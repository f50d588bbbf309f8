#include "tests/scene/full_scene.h"

namespace antipode::testing {

Scene smallScene() {
    Scene scene;
    scene.name = "small";
    Material grey, lamp;
    grey.name = "grey";
    lamp.name = "lamp";
    lamp.emission = Vec3f(2.0f);
    scene.materials = {grey, lamp};
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.material = 1;
    scene.meshes = {mesh};
    scene.spheres = {{{0, 0, -3}, 1.0f, 0}};
    return scene;
}

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
    m.abbeNumber = 42.0f;
    m.conductorEta = {1, 2, 3};
    m.conductorK = {4, 5, 6};
    m.emission = {7, 8, 9};
    m.baseColorTexture = m.emissionTexture = m.metallicRoughnessTexture = m.normalTexture = 0;
    m.transmission = 0.6f;
    m.thin = true;
    m.attenuationColor = {0.9f, 0.8f, 0.7f};
    m.attenuationDistance = 0.4f;
    m.scatteringColor = {0.3f, 0.6f, 0.2f};
    m.scatteringDistance = 0.8f;
    m.scatteringAnisotropy = 0.5f;
    m.transmissionTexture = 0;
    m.clearcoat = 0.45f;
    m.clearcoatRoughness = 0.15f;
    m.sheenColor = {0.35f, 0.25f, 0.85f};
    m.sheenRoughness = 0.65f;
    m.clearcoatTexture = m.clearcoatRoughnessTexture = m.sheenColorTexture = m.sheenRoughnessTexture = 0;
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

Scene richScene() {
    Scene s = fullScene();
    s.name = "rich ü";
    s.textures.push_back({"second", 1, 2, {9, 8, 7, 6, 5, 4, 3, 2}, true, WrapMode::Repeat, WrapMode::Clamp});
    s.materials[2].normalTexture = 1;
    const Mesh full = s.meshes[0];
    Mesh plain = smallScene().meshes[0], normals = full, uvs = full;
    plain.name = "plain";
    plain.material = 0;
    normals.name = "normals";
    normals.uvs.clear(), normals.moreUvs.clear(), normals.colors.clear(), normals.tangents.clear();
    uvs.name = "uvs";
    uvs.normals.clear(), uvs.moreUvs.clear(), uvs.colors.clear(), uvs.tangents.clear();
    s.meshes = {plain, full, normals, uvs};
    return s;
}

}  // namespace antipode::testing
