#include "scene/defaults.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "renderengine/error.h"
#include "scene/bounds.h"
#include "scene/scene_fields.h"

namespace antipode {
namespace {

bool isPositive(const Vec3f& c) { return maxComponent(c) > 0; }

}  // namespace

void addDefaultCamera(Scene& scene) {
    const Bounds3d bounds = boundsOf(scene);
    if (bounds.isEmpty()) return;

    const Vec3d center = bounds.center();
    double radius = bounds.radius();
    if (!std::isfinite(radius)) return;  // validate() names the surface
    if (radius == 0) radius = 1;
    Camera camera;
    const Vec3d forward = normalize(Vec3d(-0.5, -0.35, -1.0));
    const double distance = radius / std::sin(camera.verticalFov * 0.5);
    camera.position = Vec3f(center - forward * distance);
    camera.forward = Vec3f(forward);
    camera.focusDistance = float(distance);
    if (!isFinite(camera.position) || !(std::isfinite(camera.focusDistance) && camera.focusDistance > 0))
        throw Error(ErrorCode::Input, "no camera can frame the surfaces, whose bounds measure " +
                                          std::to_string(2 * radius) +
                                          " from corner to corner; give the scene a camera or another scale");
    scene.camera = camera;
    scene.notices.push_back("The file has no camera: the view frames everything in it.");
}

bool hasLight(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (scene.materials[mesh.material].emits()) return true;
    for (const Sphere& sphere : scene.spheres)
        if (scene.materials[sphere.material].emits()) return true;
    bool shines = false;
    const auto look = [&](const Vec3f& power) { shines |= isPositive(power); };
    forEach<Role::Intensity>(scene, look);
    forEach<Role::Irradiance>(scene, look);
    if (shines) return true;
    if (!scene.environment || !isPositive(scene.environment->radiance)) return false;
    const auto& map = scene.environment->map;
    return map.empty() || std::any_of(map.begin(), map.end(), isPositive);
}

void addDefaultLight(Scene& scene) {
    if (hasLight(scene)) return;
    scene.environment.emplace().radiance = Vec3f(1.0f);
    scene.notices.push_back("The file has no light: a constant environment of radiance 1 was added.");
}

}  // namespace antipode
