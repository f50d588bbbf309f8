#include "scene/origin.h"

#include <cmath>

#include "scene/bounds.h"
#include "scene/scene_fields.h"

namespace antipode {

Vec3f remoteCenter(const Scene& scene) {
    const Bounds3d bounds = boundsOf(scene);
    Vec3f center;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(bounds.center()[axis]) > 2 * bounds.radius()) center[axis] = float(bounds.center()[axis]);
    return center;
}

Scene movedToOrigin(Scene scene, const Vec3f& origin) {
    forEach<Role::Position>(scene, [&](Vec3f& p) { p = Vec3f(Vec3d(p) - Vec3d(origin)); });
    return scene;
}

}  // namespace antipode
