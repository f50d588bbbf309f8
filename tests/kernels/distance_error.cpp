#include "tests/kernels/distance_error.h"

#include <cmath>

namespace antipode {
namespace {

using namespace reference;

constexpr double u = 0x1p-24;

std::optional<double> exactTriangle(const Ray& ray, const TrianglePrimitive& t) {
    const Vec3d n = cross(t.b - t.a, t.c - t.a), p = t.a - ray.origin;
    const double speed = dot(n, ray.direction);
    if (speed == 0) return {};
    const Vec3d q = cross(p, ray.direction);
    // Signed volumes over the edges: all of one sign inside.
    const double v = dot(t.c - t.a, q) / speed, w = -dot(t.b - t.a, q) / speed;
    const double slack = 1e-12;
    if (v < -slack || w < -slack || v + w > 1 + slack) return {};
    const double distance = dot(n, p) / speed;
    return distance > 0 ? std::optional(distance) : std::nullopt;
}

double triangleError(const Ray& ray, const TrianglePrimitive& t) {
    const Vec3d p[] = {t.a - ray.origin, t.b - ray.origin, t.c - ray.origin};
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(ray.direction[k]) > std::abs(ray.direction[axis])) axis = k;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double dz = ray.direction[axis];
    double x[3], y[3], z[3], maxX = 0, maxY = 0, maxZ = 0;
    for (int k = 0; k < 3; ++k) {
        z[k] = p[k][axis];
        x[k] = p[k][i] - ray.direction[i] / dz * z[k];
        y[k] = p[k][j] - ray.direction[j] / dz * z[k];
        maxX = std::max(maxX, std::abs(x[k]));
        maxY = std::max(maxY, std::abs(y[k]));
        maxZ = std::max(maxZ, std::abs(z[k]));
    }
    const double e[] = {x[2] * y[1] - y[2] * x[1], x[0] * y[2] - y[0] * x[2], x[1] * y[0] - y[1] * x[0]};
    const double determinant = std::abs(e[0] + e[1] + e[2]);
    const double maxE = std::max({std::abs(e[0]), std::abs(e[1]), std::abs(e[2])});
    const double deltaX = 5 * u * (maxX + maxZ), deltaY = 5 * u * (maxY + maxZ), deltaZ = 3 * u * maxZ;
    const double deltaE = 2 * (2 * u * maxX * maxY + deltaY * maxX + deltaX * maxY);
    return 3 * (3 * u * maxE * maxZ + deltaE * maxZ + deltaZ * maxE) / (determinant * std::abs(dz));
}

double sphereError(const Ray& ray, const SpherePrimitive& s) {
    const Vec3d f = ray.origin - s.center;
    const double b = dot(f, ray.direction), r2 = s.radius * s.radius, f2 = dot(f, f);
    const Vec3d l = f - ray.direction * b;
    const double discriminant = std::max(r2 - dot(l, l), 0.0);
    const double discriminantError = 16 * u * (r2 + length(l) * std::sqrt(f2));
    const double rootError =
        std::min(std::sqrt(discriminantError), discriminantError / std::sqrt(discriminant + 1e-300));
    return rootError + 8 * u * std::sqrt(f2) + 8 * u * (f2 + r2) / (std::abs(b) + std::sqrt(discriminant));
}

}  // namespace

std::optional<double> exactDistance(const Geometry& geometry, const Ray& ray, PrimitiveId primitive) {
    const size_t triangles = geometry.triangles().size();
    if (primitive < triangles) return exactTriangle(ray, geometry.triangles()[primitive]);
    const SpherePrimitive& s = geometry.spheres()[primitive - triangles];
    const Vec3d f = ray.origin - s.center;
    const double b = dot(f, ray.direction);
    const Vec3d l = f - ray.direction * b;
    const double discriminant = s.radius * s.radius - dot(l, l);
    if (discriminant < 0) return {};
    const double root = std::sqrt(discriminant);
    const double distance = -b - root > 0 ? -b - root : -b + root;
    return distance > 0 ? std::optional(distance) : std::nullopt;
}

double distanceError(const Geometry& geometry, const Ray& ray, PrimitiveId primitive) {
    const size_t triangles = geometry.triangles().size();
    return primitive < triangles ? triangleError(ray, geometry.triangles()[primitive])
                                 : sphereError(ray, geometry.spheres()[primitive - triangles]);
}

}  // namespace antipode
