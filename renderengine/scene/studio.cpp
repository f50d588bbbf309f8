#include "scene/studio.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/bounds.h"

namespace antipode {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Where the camera is, seen along the ground, and what is left of it.
struct Stand {
    Vec3d towardsCamera, left;
};

Stand standOf(const Camera& camera) {
    Vec3d back(-double(camera.forward.x), 0, -double(camera.forward.z));
    if (!(length(back) > 1e-3)) back = Vec3d(0, 0, 1);
    back = normalize(back);
    return {back, cross(back, Vec3d(0, 1, 0))};
}

/// A disc of light in the sky with a soft edge.
struct Panel {
    Vec3d direction;
    double innerAngle, outerAngle;  ///< radians
    double radiance;

    double seenAt(const Vec3d& d) const {
        const double angle = std::acos(std::clamp(dot(d, direction), -1.0, 1.0));
        const double t = std::clamp((outerAngle - angle) / (outerAngle - innerAngle), 0.0, 1.0);
        return radiance * t * t * (3 - 2 * t);
    }
};

/// Row 0 is up; see Environment.
template <class Radiance>
Environment paint(Radiance radianceAt) {
    Environment environment;
    environment.radiance = Vec3f(1.0f);
    environment.width = 256;
    environment.height = 128;
    environment.map.reserve(size_t(environment.width) * environment.height);
    for (uint32_t y = 0; y < environment.height; ++y) {
        const double theta = std::numbers::pi * (y + 0.5) / environment.height;
        for (uint32_t x = 0; x < environment.width; ++x) {
            const double phi = 2 * std::numbers::pi * ((x + 0.5) / environment.width - 0.5);
            environment.map.push_back(Vec3f(
                radianceAt(Vec3d(std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta)))));
        }
    }
    return environment;
}

Environment softSky(const Stand& stand) {
    const Vec3d up(0, 1, 0);
    const Panel panels[] = {
        {normalize(stand.left * 0.8 + up + stand.towardsCamera * 0.6), 26 * kDegree, 38 * kDegree, 4.0},  // key
        {normalize(stand.left * -1.0 + up * 0.45 + stand.towardsCamera * 0.5), 20 * kDegree, 50 * kDegree,
         0.6},                                                                                             // fill
        {normalize(stand.left * -0.3 + up * 0.7 - stand.towardsCamera), 12 * kDegree, 24 * kDegree, 2.0},  // rim
    };
    return paint([&](const Vec3d& d) {
        // Grey that white stands out from, darker towards the zenith and below.
        double radiance = d.y > 0 ? 0.36 - 0.16 * std::sqrt(d.y) : 0.36 + 0.1 * std::max(d.y, -1.0);
        for (const Panel& panel : panels) radiance += panel.seenAt(d);
        return Vec3d(radiance);
    });
}

Environment blueSky() {
    const Vec3d zenith(0.18, 0.34, 0.72), horizon(0.62, 0.74, 0.86), below(0.32, 0.31, 0.29);
    return paint([&](const Vec3d& d) {
        if (d.y < 0) return below;
        const double t = std::sqrt(d.y);
        return horizon * (1 - t) + zenith * t;
    });
}

void addGround(Scene& scene) {
    const Bounds3d bounds = boundsOf(scene);
    if (bounds.isEmpty() || !(bounds.radius() > 0) || !std::isfinite(bounds.radius())) return;
    const double below = bounds.lower.y - 1e-4 * bounds.radius();
    if (scene.camera.position.y < below) return;
    Material material;
    material.name = "studio ground";
    material.baseColor = Vec3f(0.35f);
    Mesh ground;
    ground.name = "studio ground";
    ground.material = uint32_t(scene.materials.size());
    const double reach = 30 * bounds.radius();
    const Vec3d center = bounds.center();
    for (const auto& [x, z] : {std::pair(-1, 1), std::pair(1, 1), std::pair(1, -1), std::pair(-1, -1)})
        ground.positions.push_back(Vec3f(Vec3d(center.x + x * reach, below, center.z + z * reach)));
    ground.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.materials.push_back(std::move(material));
    scene.meshes.push_back(std::move(ground));
}

}  // namespace

void addStudio(Scene& scene, Studio studio) {
    if (studio == Studio::None) {
        scene.environment.emplace().radiance = Vec3f(1.0f);
        return;
    }
    const Stand stand = standOf(scene.camera);
    scene.environment = studio == Studio::Soft ? softSky(stand) : blueSky();
    if (studio == Studio::Sun) {
        const Vec3d towards = normalize(stand.left * 0.7 + Vec3d(0, 0.9, 0) + stand.towardsCamera * 0.6);
        scene.directionalLights.push_back({Vec3f(-towards), Vec3f(2.9f, 2.7f, 2.4f)});
    }
    addGround(scene);
}

}  // namespace antipode
