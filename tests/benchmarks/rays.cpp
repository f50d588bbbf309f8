#include "tests/benchmarks/rays.h"

#include <cmath>
#include <numbers>

#include "tests/benchmarks/embree_scene.h"
#include "tests/support/random.h"

namespace antipode::benchmark {
namespace {

// In units of the largest coordinate that takes part in a hit point: some hundred times float's rounding error.
constexpr float relativeOffset = 3e-5f;

/// Any two unit vectors that make a frame with the unit vector n (Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017).
std::pair<Vec3f, Vec3f> tangents(const Vec3f& n) {
    const float sign = std::copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

Vec3f cosineDirection(const Vec3f& normal, Random& random) {
    const auto [x, y] = tangents(normal);
    const double u = random.uniform(), azimuth = 2.0 * std::numbers::pi * random.uniform();
    const float radius = float(std::sqrt(u));
    return x * (radius * float(std::cos(azimuth))) + y * (radius * float(std::sin(azimuth))) +
           normal * float(std::sqrt(1.0 - u));
}

void shuffle(std::vector<Ray>& rays, Random& random) {
    for (size_t i = rays.size(); i > 1; --i) std::swap(rays[i - 1], rays[random.index(uint32_t(i))]);
}

}  // namespace

std::vector<Ray> primaryRays(const Camera& camera, uint32_t side) {
    const Vec3f right = normalize(cross(camera.forward, camera.up)), up = cross(right, camera.forward);
    const float half = std::tan(0.5f * camera.verticalFov);
    std::vector<Ray> rays;
    rays.reserve(size_t(side) * side);
    for (uint32_t row = 0; row < side; ++row)
        for (uint32_t column = 0; column < side; ++column) {
            const float x = (2.0f * (float(column) + 0.5f) / float(side) - 1.0f) * half;
            const float y = (1.0f - 2.0f * (float(row) + 0.5f) / float(side)) * half;
            rays.push_back({camera.position, normalize(camera.forward + right * x + up * y)});
        }
    return rays;
}

std::vector<Ray> shuffledDiffuseRays(const std::vector<Ray>& rays, const EmbreeScene& scene) {
    Random random(1);
    std::vector<Ray> diffuse;
    for (const Ray& ray : rays) {
        const EmbreeHit hit = scene.closestHit(ray);
        if (!hit.found) continue;
        const Vec3f point = ray.origin + ray.direction * hit.distance;
        const Vec3f normal = dot(hit.normal, ray.direction) > 0.0f ? -hit.normal : hit.normal;
        const float scale = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z), hit.distance});
        diffuse.push_back({point + normal * (relativeOffset * scale), cosineDirection(normal, random)});
    }
    shuffle(diffuse, random);
    return diffuse;
}

}  // namespace antipode::benchmark
