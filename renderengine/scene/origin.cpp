#include "scene/origin.h"

#include <algorithm>
#include <cmath>

#include "scene/bounds.h"

namespace antipode {

Vec3f remoteCenter(const Scene& scene) {
    const Bounds3d bounds = boundsOf(scene);
    Vec3f center;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(bounds.center()[axis]) > 2 * bounds.radius()) center[axis] = float(bounds.center()[axis]);
    return center;
}

Scene movedToOrigin(Scene scene, const Vec3f& origin) {
    const auto move = [&](Vec3f& p) { p = Vec3f(Vec3d(p) - Vec3d(origin)); };
    for (Mesh& mesh : scene.meshes) std::for_each(mesh.positions.begin(), mesh.positions.end(), move);
    for (Sphere& sphere : scene.spheres) move(sphere.center);
    for (PointLight& light : scene.pointLights) move(light.position);
    for (SpotLight& light : scene.spotLights) move(light.position);
    move(scene.camera.position);
    return scene;
}

}  // namespace antipode
