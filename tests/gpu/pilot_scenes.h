// Small scenes for a camera at (0, 0, 5) that looks along −z.
#pragma once

#include "renderengine/scene.h"

namespace antipode::test {

inline Material lambert(float albedo) {
    Material material;
    material.baseColor = Vec3f(albedo);
    return material;
}

inline Material specular(MaterialKind kind) {
    Material material;
    material.kind = kind;
    return material;
}

/// A square about `center` in the plane that `u` and `v`, half its sides, span.
inline Mesh square(const Vec3f& center, const Vec3f& u, const Vec3f& v, uint32_t material) {
    Mesh mesh;
    mesh.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    return mesh;
}

/// A grey wall at z = 0, 20 wide, which fills the picture.
inline Scene wall() {
    Scene scene;
    scene.materials = {lambert(0.5f)};
    scene.meshes = {square({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, 0)};
    scene.pointLights = {{{0, 0, 4}, Vec3f(1.0f)}};
    scene.camera.position = {0, 0, 5};
    scene.camera.verticalFov = 0.7f;
    return scene;
}

/// A ball on a floor of this half side, seen from above its rim; half of the picture is above the small floor.
inline Scene ballOnFloor(float halfSide) {
    Scene scene;
    scene.materials = {lambert(0.5f)};
    scene.meshes = {square({0, -1, 0}, {halfSide, 0, 0}, {0, 0, -halfSide}, 0)};
    scene.spheres = {{{0, 0, 0}, 1.0f, 0}};
    scene.pointLights = {{{0, 4, 0}, Vec3f(1.0f)}};
    scene.camera.position = {0, 1.5f, 6};
    scene.camera.forward = normalize(Vec3f(0, -0.3f, -1));
    return scene;
}

}  // namespace antipode::test
