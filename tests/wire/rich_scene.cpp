#include "tests/wire/rich_scene.h"

namespace antipode::wire::testing {

Scene richScene() {
    Scene s;
    s.name = "rich ü";
    s.textures = {{"first", 2, 1, {1, 2, 3, 4, 5, 6, 7, 8}, false, WrapMode::Clamp, WrapMode::Mirror},
                  {"second", 1, 2, {9, 8, 7, 6, 5, 4, 3, 2}, true, WrapMode::Repeat, WrapMode::Clamp}};
    Material grey, lamp;
    grey.name = "grey";
    lamp.name = "lamp";
    lamp.kind = MaterialKind::MetallicRoughness;
    lamp.emission = {7, 8, 9};
    lamp.baseColorTexture = 0;
    lamp.normalTexture = 1;
    lamp.alphaCutoff = 0.6f;
    lamp.twoSided = false;
    s.materials = {grey, lamp};
    Mesh plain;
    plain.name = "plain";
    plain.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    plain.triangles = {{0, 1, 2}};
    Mesh smooth = plain;
    smooth.name = "smooth";
    smooth.material = 1;
    smooth.normals.assign(3, Vec3f(normalize(Vec3d(1, 2, 3))));
    smooth.uvs = {{0, 0}, {0.1f, 0.9f}, {1.0f / 3, 7}};
    smooth.triangles = {{2, 1, 0}, {0, 1, 2}};
    Mesh normals = smooth, uvs = smooth;
    normals.uvs.clear();
    uvs.normals.clear();
    s.meshes = {plain, smooth, normals, uvs};
    s.spheres = {{{0, 0, -3}, 1.0f, 0}};
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

}  // namespace antipode::wire::testing
