// The smallest scene that has a size and a place.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// A box of this half size about a centre, seen from its front.
inline Scene boxAt(const Vec3f& center, float halfSize) {
    Scene scene;
    Mesh mesh;
    mesh.name = "box";
    for (const float x : {-1.f, 1.f})
        for (const float y : {-1.f, 1.f})
            for (const float z : {-1.f, 1.f}) mesh.positions.push_back(center + Vec3f(x, y, z) * halfSize);
    mesh.triangles = {{0, 1, 2}, {5, 6, 7}};
    scene.meshes.push_back(mesh);
    scene.camera.position = center + Vec3f(0, 0, 3 * halfSize);
    return scene;
}

}  // namespace antipode
