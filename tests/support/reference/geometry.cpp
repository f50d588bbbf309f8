#include "support/reference/geometry.h"

#include <algorithm>
#include <cmath>

#include "renderengine/error.h"

namespace antipode::reference {

Frame::Frame(const Vec3d& n) : normal(n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
}

namespace {

/// Möller & Trumbore 1997, both sides.
std::optional<double> intersectTriangle(const Ray& ray, const TrianglePrimitive& t) {
    const Vec3d e1 = t.b - t.a, e2 = t.c - t.a, p = cross(ray.direction, e2);
    const double det = dot(e1, p);
    if (det == 0) return {};
    const Vec3d s = ray.origin - t.a;
    const double u = dot(s, p) / det;
    if (u < 0 || u > 1) return {};
    const Vec3d q = cross(s, e1);
    const double v = dot(ray.direction, q) / det;
    if (v < 0 || u + v > 1) return {};
    const double distance = dot(e2, q) / det;
    return distance > 0 ? std::optional(distance) : std::nullopt;
}

std::optional<double> intersectSphere(const Ray& ray, const SpherePrimitive& sphere, bool startsOn) {
    const Vec3d s = ray.origin - sphere.center;
    const double b = dot(s, ray.direction);
    if (startsOn) return b < 0 ? std::optional(-2 * b) : std::nullopt;  // one root is the origin itself
    const Vec3d closest = s - ray.direction * b;
    const double quarterDiscriminant = sphere.radius * sphere.radius - dot(closest, closest);
    if (quarterDiscriminant < 0) return {};
    const double root = std::sqrt(quarterDiscriminant);
    if (-b - root > 0) return -b - root;
    if (-b + root > 0) return -b + root;
    return {};
}

}  // namespace

Geometry::Geometry(const Scene& scene) {
    Vec3d low(kInfinity), high(-kInfinity);
    const auto grow = [&](const Vec3d& p, double margin) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], p[axis] - margin);
            high[axis] = std::max(high[axis], p[axis] + margin);
        }
    };
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.normals.empty())
            throw Error(ErrorCode::Usage, "The reference renderer has no shading normals: mesh '" + mesh.name + "'.");
        for (const auto& index : mesh.triangles) {
            triangles_.push_back({Vec3d(mesh.positions[index[0]]), Vec3d(mesh.positions[index[1]]),
                                  Vec3d(mesh.positions[index[2]]), mesh.material});
            for (const Vec3d& p : {triangles_.back().a, triangles_.back().b, triangles_.back().c}) grow(p, 0);
        }
    }
    for (const Sphere& sphere : scene.spheres) {
        spheres_.push_back({Vec3d(sphere.center), double(sphere.radius), sphere.material});
        grow(spheres_.back().center, spheres_.back().radius);
    }
    boundingCenter_ = (low + high) / 2.0;
    boundingRadius_ = length(high - low) / 2;
}

std::optional<double> Geometry::intersectPrimitive(const Ray& ray, PrimitiveId id) const {
    if (id >= triangles_.size()) return intersectSphere(ray, spheres_[id - triangles_.size()], ray.startsOn == id);
    return ray.startsOn == id ? std::nullopt : intersectTriangle(ray, triangles_[id]);
}

std::optional<Hit> Geometry::intersect(const Ray& ray) const {
    Hit hit;
    hit.distance = kInfinity;
    for (PrimitiveId id = 0; id < triangles_.size() + spheres_.size(); ++id) {
        const auto distance = intersectPrimitive(ray, id);
        if (!distance || *distance >= hit.distance) continue;
        hit.distance = *distance;
        hit.primitive = id;
    }
    if (hit.primitive == kNoPrimitive) return {};
    hit.position = ray.origin + ray.direction * hit.distance;
    if (hit.primitive < triangles_.size()) {
        const TrianglePrimitive& triangle = triangles_[hit.primitive];
        hit.normal = triangle.normal();
        hit.material = triangle.material;
    } else {
        const SpherePrimitive& sphere = spheres_[hit.primitive - triangles_.size()];
        hit.normal = normalize(hit.position - sphere.center);
        hit.material = sphere.material;
    }
    return hit;
}

bool Geometry::occluded(const Ray& ray, double distance, PrimitiveId endsOn) const {
    for (PrimitiveId id = 0; id < triangles_.size() + spheres_.size(); ++id) {
        // A flat primitive cannot hide its own points; a sphere can, from its far side: the end itself is told from an
        // earlier hit by a relative margin.
        if (id == endsOn && id < triangles_.size()) continue;
        const auto hit = intersectPrimitive(ray, id);
        if (hit && *hit < (id == endsOn ? distance * (1 - 1e-9) : distance)) return true;
    }
    return false;
}

}  // namespace antipode::reference
