#include "scene/bounds.h"

namespace antipode {

Bounds3d boundsOf(const Mesh& mesh) {
    Bounds3d bounds;
    for (const Vec3f& p : mesh.positions) bounds.add(Vec3d(p));
    return bounds;
}

Bounds3d boundsOf(const Sphere& sphere) {
    Bounds3d bounds;
    bounds.add(Vec3d(sphere.center) - Vec3d(sphere.radius));
    bounds.add(Vec3d(sphere.center) + Vec3d(sphere.radius));
    return bounds;
}

Bounds3d boundsOf(const Scene& scene) {
    Bounds3d bounds;
    for (const Mesh& mesh : scene.meshes) bounds.add(boundsOf(mesh));
    for (const Sphere& sphere : scene.spheres) bounds.add(boundsOf(sphere));
    return bounds;
}

}  // namespace antipode
