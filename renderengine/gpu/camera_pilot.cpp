#include "gpu/camera_pilot.h"

#include <cmath>

#include "gpu/host_tracer.h"
#include "gpu/pack_materials.h"

namespace antipode {
namespace {

/// Were they random, the rank of a quartile would err by one per cent of all; the sequence below does better.
constexpr uint32_t pathCount = 2048;
constexpr uint32_t longestChain = 32;  ///< specular surfaces one after the other

/// Points that fill the unit square evenly (the additive recurrence of the plastic number, Roberts 2018).
std::pair<double, double> pointOf(uint32_t i) {
    constexpr double a = 0.7548776662466927, b = 0.5698402909980532;
    const double u = 0.5 + a * i, v = 0.5 + b * i;
    return {u - std::floor(u), v - std::floor(v)};
}

/// Unpolarised reflectance of a smooth interface; `eta`: index before over index behind, `cosIn` > 0.
double fresnel(double eta, double cosIn) {
    const double sinSquared = eta * eta * (1 - cosIn * cosIn);
    if (sinSquared >= 1) return 1;
    const double cosOut = std::sqrt(1 - sinSquared);
    const double s = (eta * cosIn - cosOut) / (eta * cosIn + cosOut);
    const double p = (cosIn - eta * cosOut) / (cosIn + eta * cosOut);
    return 0.5 * (s * s + p * p);
}

/// Where a specular surface sends most of the light that comes along `direction`.
Vec3d continued(const Material& material, const Vec3d& direction, const Vec3d& frontNormal) {
    const bool front = dot(direction, frontNormal) < 0;
    const Vec3d normal = front ? frontNormal : -frontNormal;
    const double cosIn = -dot(direction, normal);
    if (material.transmits() && material.thin) return direction;
    if (material.transmits()) {
        const double eta = front ? 1 / double(material.ior) : double(material.ior);
        if (fresnel(eta, cosIn) < 0.5) {
            const double cosOut = std::sqrt(1 - eta * eta * (1 - cosIn * cosIn));
            return normalize(direction * eta + normal * (eta * cosIn - cosOut));
        }
    }
    return normalize(direction + normal * (2 * cosIn));
}

/// Length of the path to the first surface on which vertices merge, in the tracer's units.
std::optional<double> pathLength(const HostTracer& tracer, const Scene& scene, Vec3d origin, Vec3d direction) {
    double length = 0;
    std::optional<uint32_t> left;
    for (uint32_t i = 0; i < longestChain; ++i) {
        const auto hit = tracer.closest(origin, direction, left);
        if (!hit) return {};
        length += hit->distance;
        const Material& material = scene.materials[hit->material];
        if (isBlack(material)) return {};
        if (!isSpecular(material)) return length;
        origin += direction * hit->distance;
        direction = continued(material, direction, hit->normal);
        left = hit->surface;
    }
    return {};
}

}  // namespace

PilotPaths tracePilotPaths(const Scene& scene, double aspectRatio) {
    const HostTracer tracer(scene);
    const Camera& camera = scene.camera;
    const Vec3d forward = normalize(Vec3d(camera.forward));
    const Vec3d right = normalize(cross(forward, Vec3d(camera.up))), up = cross(right, forward);
    const double height = 2 * std::tan(0.5 * double(camera.verticalFov));  // at distance 1 along `forward`
    PilotPaths seen{pathCount, {}};
    for (uint32_t i = 0; i < seen.paths; ++i) {
        const auto [u, v] = pointOf(i);
        Vec3d origin(camera.position), direction = forward;
        const double parallel = camera.orthographicHeight;
        if (parallel > 0)
            origin += (right * ((u - 0.5) * aspectRatio) + up * (v - 0.5)) * parallel;
        else
            direction = normalize(forward + right * ((u - 0.5) * height * aspectRatio) + up * ((v - 0.5) * height));
        const auto length = pathLength(tracer, scene, origin * tracer.unit(), direction);
        if (length)
            seen.pictureHeights.push_back(parallel > 0 ? parallel
                                                       : *length * dot(direction, forward) * height / tracer.unit());
    }
    return seen;
}

}  // namespace antipode
