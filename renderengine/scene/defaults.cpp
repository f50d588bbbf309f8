#include "scene/defaults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "renderengine/error.h"
#include "scene/bounds.h"
#include "scene/light_pilot.h"
#include "scene/scene_fields.h"
#include "scene/studio.h"

namespace antipode {
namespace {

bool isPositive(const Vec3f& c) { return maxComponent(c) > 0; }

/// What the view should show: the vertices within the box that holds the middle 99 % of them along each axis, four
/// times as wide.
std::vector<Vec3d> pointsToShow(const Scene& scene) {
    std::vector<Vec3d> points;
    for (const Mesh& mesh : scene.meshes)
        for (const auto& triangle : mesh.triangles)
            for (uint32_t vertex : triangle) points.emplace_back(mesh.positions[vertex]);
    for (const Sphere& sphere : scene.spheres)
        for (int corner = 0; corner < 8; ++corner)
            points.push_back(Vec3d(sphere.center) +
                             Vec3d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1) *
                                 double(sphere.radius));
    if (points.empty()) return points;
    Vec3d low, high;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        values.reserve(points.size());
        for (const Vec3d& p : points) values.push_back(p[axis]);
        std::sort(values.begin(), values.end());
        const size_t cut = values.size() / 200;
        low[axis] = values[cut];
        high[axis] = values[values.size() - 1 - cut];
    }
    const Vec3d center = (low + high) * 0.5;
    const double reach = 2 * maxComponent(high - low);  // half of four times
    if (!(reach > 0)) return points;
    std::erase_if(points, [&](const Vec3d& p) {
        const Vec3d d = p - center;
        return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) > reach;
    });
    return points;
}

struct Wall {
    double distance;
    bool isFront;  ///< its front is seen
};

/// The first surface along the ray; nothing where it meets none. Looks at every triangle.
std::optional<Wall> wallAlong(const Scene& scene, const Vec3d& origin, const Vec3d& direction) {
    std::optional<Wall> nearest;
    for (const Mesh& mesh : scene.meshes) {
        for (const auto& t : mesh.triangles) {
            const Vec3d a(mesh.positions[t[0]]);
            const Vec3d e1 = Vec3d(mesh.positions[t[1]]) - a, e2 = Vec3d(mesh.positions[t[2]]) - a;
            const Vec3d p = cross(direction, e2);
            const double determinant = dot(e1, p);
            if (determinant == 0) continue;
            const Vec3d s = origin - a, q = cross(s, e1);
            const double u = dot(s, p) / determinant, v = dot(direction, q) / determinant;
            const double distance = dot(e2, q) / determinant;
            if (u < 0 || v < 0 || u + v > 1 || !(distance > 0)) continue;
            if (!nearest || distance < nearest->distance) nearest = Wall{distance, determinant > 0};
        }
    }
    return nearest;
}

/// Whether something shines in there.
bool hasLightInside(const Scene& scene) {
    bool isInside = false;
    forEachLight(scene, [&](const auto& light) {
        isInside |= requires { light.position; };
    });
    return isInside || std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                   [&](const Mesh& mesh) { return scene.materials[mesh.material].emits(); });
}

/// A view from inside where the model is a room: walls all around its middle, with their fronts towards it, and a light
/// among them.
std::optional<Camera> cameraInRoom(const Scene& scene, const Bounds3d& bounds) {
    constexpr size_t mostTriangles = 2000000;
    size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes) triangles += mesh.triangles.size();
    if (triangles > mostTriangles || !hasLightInside(scene)) return {};
    constexpr int directions = 48, needed = 46;
    const Vec3d center = bounds.center();
    int fronts = 0;
    for (int i = 0; i < directions; ++i) {
        // Spherical Fibonacci points (Keinert et al. 2015).
        const double y = 1 - (2 * i + 1.0) / directions, r = std::sqrt(1 - y * y), phi = 2.399963229728653 * i;
        const auto wall = wallAlong(scene, center, Vec3d(r * std::cos(phi), y, r * std::sin(phi)));
        fronts += wall && wall->isFront;
        if (fronts + directions - 1 - i < needed) return {};
    }
    const Vec3d towardsCorner = normalize(Vec3d(0.5, 0.15, 1.0));
    const auto wall = wallAlong(scene, center, towardsCorner);
    if (!wall) return {};
    Camera camera;
    camera.position = Vec3f(center + towardsCorner * (0.85 * wall->distance));
    camera.forward = Vec3f(-towardsCorner);
    camera.verticalFov = 1.2217305f;  // 70°
    camera.focusDistance = float(wall->distance);
    return camera;
}

/// Points in the image's coordinates, -1 to 1 in x and y, and their depth in z.
class Projection {
public:
    explicit Projection(const Scene& scene)
        : camera_(scene.camera),
          forward_(camera_.forward),
          right_(normalize(cross(forward_, Vec3d(camera_.up)))),
          up_(cross(right_, forward_)),
          aspect_(double(scene.imageWidth) / scene.imageHeight),
          half_(isParallel() ? camera_.orthographicHeight / 2.0 : std::tan(camera_.verticalFov / 2.0)) {}

    Vec3d operator()(const Vec3f& position) const {
        const Vec3d d = Vec3d(position) - Vec3d(camera_.position);
        const double z = dot(d, forward_), height = isParallel() ? half_ : half_ * z;
        return Vec3d(dot(d, right_) / (height * aspect_), dot(d, up_) / height, z);
    }

private:
    bool isParallel() const { return camera_.orthographicHeight > 0; }

    const Camera& camera_;
    Vec3d forward_, right_, up_;
    double aspect_, half_;
};

}  // namespace

void addDefaultCamera(Scene& scene, const std::string& why) {
    const Bounds3d bounds = boundsOf(scene);
    if (bounds.isEmpty() || !std::isfinite(bounds.radius())) return;  // validate() names the surface
    if (const std::optional<Camera> inside = cameraInRoom(scene, bounds)) {
        scene.camera = *inside;
        scene.notices.push_back(why + "; the model is a closed room, seen from inside.");
        return;
    }
    const std::vector<Vec3d> points = pointsToShow(scene);
    Bounds3d shown;
    for (const Vec3d& p : points) shown.add(p);
    if (shown.isEmpty()) shown = bounds;
    const Vec3d center = shown.center();
    const double radius = shown.radius() > 0 ? shown.radius() : 1;
    Camera camera;
    const Vec3d forward = normalize(Vec3d(-0.5, -0.35, -1.0));
    const Vec3d right = normalize(cross(forward, Vec3d(camera.up))), up = cross(right, forward);
    constexpr double margin = 1.08;
    const double tangentY = std::tan(camera.verticalFov / 2.0) / margin;
    // An image of no pixels has no shape; validate() refuses it.
    const bool hasPixels = scene.imageWidth > 0 && scene.imageHeight > 0;
    const double tangentX = hasPixels ? tangentY * scene.imageWidth / scene.imageHeight : tangentY;
    double distance = radius;
    for (const Vec3d& p : points) {
        const Vec3d d = p - center;
        distance = std::max({distance, std::abs(dot(d, right)) / tangentX - dot(d, forward),
                             std::abs(dot(d, up)) / tangentY - dot(d, forward)});
    }
    camera.position = Vec3f(center - forward * distance);
    camera.forward = Vec3f(forward);
    camera.focusDistance = float(distance);
    if (!isFinite(camera.position) || !(std::isfinite(camera.focusDistance) && camera.focusDistance > 0))
        throw Error(ErrorCode::Input, "no camera can frame the surfaces, whose bounds measure " +
                                          std::to_string(2 * radius) +
                                          " from corner to corner; give the scene a camera or another scale");
    scene.camera = camera;
    scene.notices.push_back(why + ": the view frames everything in it.");
}

bool seesSurfaces(const Scene& scene) {
    if (!scene.spheres.empty()) return true;
    const Projection project(scene);
    Bounds3d shown;
    for (const Mesh& mesh : scene.meshes) {
        for (const auto& triangle : mesh.triangles) {
            Bounds3d bounds;
            bool isBefore = true, isBehind = true;
            for (uint32_t vertex : triangle) {
                const Vec3d p = project(mesh.positions[vertex]);
                isBefore = isBefore && p.z > 0;
                isBehind = isBehind && p.z <= 0;
                bounds.add(p);
            }
            if (isBehind) continue;
            if (!isBefore) return true;  // around the camera
            if (bounds.upper.x < -1 || bounds.lower.x > 1 || bounds.upper.y < -1 || bounds.lower.y > 1) continue;
            shown.add(bounds.lower);
            shown.add(bounds.upper);
        }
    }
    if (shown.isEmpty()) return false;
    const auto extent = [](double lower, double upper) { return std::min(upper, 1.0) - std::max(lower, -1.0); };
    constexpr double image = 4;
    return extent(shown.lower.x, shown.upper.x) * extent(shown.lower.y, shown.upper.y) >= image / 1000;
}

bool isLeftOver(const Scene& scene) {
    // With +Y up.
    constexpr std::array starts = {Vec3d(7.481132, 5.343665, 6.507640), Vec3d(7.358891, 4.958309, 6.925791)};
    const Vec3d stand = normalize(Vec3d(scene.camera.position));
    const bool isThere = std::any_of(starts.begin(), starts.end(), [&](const Vec3d& start) {
        return length(stand - normalize(start)) < 1e-3 &&
               length(Vec3d(scene.camera.forward) + normalize(start)) < 0.1;  // towards the origin, nearly
    });
    if (!isThere) return false;
    const Projection project(scene);
    size_t all = 0, inView = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (const Vec3f& position : mesh.positions) {
            const Vec3d p = project(position);
            ++all;
            inView += p.z > 0 && std::abs(p.x) <= 1 && std::abs(p.y) <= 1;
        }
    }
    return 2 * inView < all;
}

bool hasLamps(const Scene& scene) {
    bool shines = false;
    const auto look = [&](const Vec3f& power) { shines |= isPositive(power); };
    forEachLight(scene, [&](const auto& light) {
        forEach<Role::Intensity>(light, look);
        forEach<Role::Irradiance>(light, look);
        if constexpr (requires { light.radiance; })
            if (light.map.empty() || std::ranges::any_of(light.map, isPositive)) look(light.radiance);
    });
    return shines;
}

bool hasLight(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        if (scene.materials[mesh.material].emits()) return true;
    for (const Sphere& sphere : scene.spheres)
        if (scene.materials[sphere.material].emits()) return true;
    return hasLamps(scene);
}

void addDefaultLight(Scene& scene, Studio studio) {
    const bool hasNone = !hasLight(scene);
    if (!hasNone && lightsTheView(scene)) return;
    addStudio(scene, studio);
    const std::string why =
        hasNone ? "The file has no light" : "The file's own emitters light nothing that the camera sees";
    const char* what = studio == Studio::None   ? "a constant environment of radiance 1 was added."
                       : studio == Studio::Soft ? "a studio with a soft key light was added (--studio)."
                                                : "a sun and a sky were added (--studio).";
    scene.notices.push_back(why + ": " + what);
}

}  // namespace antipode
