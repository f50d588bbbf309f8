#include "scene/light_pilot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/defaults.h"

namespace antipode {
namespace {

constexpr size_t kPoints = 512, kEmitters = 256;

struct SurfacePoint {
    Vec3d position, normal;
    Vec3d emission;  ///< of the material; without textures
    bool emitsBothSides = false;
};

/// Triangles of one kind, drawn by area: evenly spaced in the sum of areas, so that no random number is needed.
class AreaSamples {
public:
    void add(const Scene& scene, const Mesh& mesh) {
        const Material& material = scene.materials[mesh.material];
        for (const auto& t : mesh.triangles) {
            const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
            const Vec3d n = cross(b - a, c - a);
            const double area = length(n) / 2;
            if (!(area > 0) || !std::isfinite(area)) continue;
            total_ += area;
            sums_.push_back(total_);
            triangles_.push_back({a, b - a, c - a, normalize(n), Vec3d(material.emission), material.emitsBothSides});
        }
    }
    void add(const Scene& scene, const Sphere& sphere) {
        // The six ends of its axes stand for it.
        const Material& material = scene.materials[sphere.material];
        const double area = 4 * std::numbers::pi * double(sphere.radius) * double(sphere.radius) / 6;
        for (int i = 0; i < 6; ++i) {
            Vec3d n;
            n[i / 2] = i % 2 ? 1 : -1;
            total_ += area;
            sums_.push_back(total_);
            triangles_.push_back({Vec3d(sphere.center) + n * double(sphere.radius),
                                  {},
                                  {},
                                  n,
                                  Vec3d(material.emission),
                                  material.emitsBothSides});
        }
    }
    double area() const { return total_; }

    std::vector<SurfacePoint> draw(size_t count) const {
        std::vector<SurfacePoint> points;
        for (size_t i = 0; i < count && total_ > 0; ++i) {
            const double at = total_ * (double(i) + 0.5) / double(count);
            const auto found = std::upper_bound(sums_.begin(), sums_.end(), at);
            const Triangle& t = triangles_[std::min(size_t(found - sums_.begin()), triangles_.size() - 1)];
            // The R2 sequence (Roberts 2018), folded into the triangle.
            double u = std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0);
            double v = std::fmod(0.5 + 0.5698402909980532 * double(i), 1.0);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            points.push_back({t.corner + t.edge1 * u + t.edge2 * v, t.normal, t.emission, t.emitsBothSides});
        }
        return points;
    }

private:
    struct Triangle {
        Vec3d corner, edge1, edge2, normal, emission;
        bool emitsBothSides;
    };
    std::vector<Triangle> triangles_;
    std::vector<double> sums_;
    double total_ = 0;
};

bool isInView(const Camera& camera, double aspect, const Vec3d& point) {
    const Vec3d forward(camera.forward), right = normalize(cross(forward, Vec3d(camera.up))),
                                         up = cross(right, forward);
    const Vec3d d = point - Vec3d(camera.position);
    const double z = dot(d, forward), tangent = std::tan(camera.verticalFov / 2.0);
    return z > 0 && std::abs(dot(d, up)) <= z * tangent && std::abs(dot(d, right)) <= z * tangent * aspect;
}

}  // namespace

bool lightsTheView(const Scene& scene) {
    if (hasLamps(scene)) return true;  // what they light a camera's exposure can show
    AreaSamples surfaces, emitters;
    const auto add = [&](const auto& shape) {
        surfaces.add(scene, shape);
        if (scene.materials[shape.material].emits()) emitters.add(scene, shape);
    };
    for (const Mesh& mesh : scene.meshes) add(mesh);
    for (const Sphere& sphere : scene.spheres) add(sphere);
    if (!(emitters.area() > 0)) return false;

    const std::vector<SurfacePoint> lamps = emitters.draw(kEmitters);
    double brightest = 0;
    for (const SurfacePoint& lamp : lamps) brightest = std::max(brightest, maxComponent(lamp.emission));
    const double worthMention = std::min(0.01, brightest / 100);
    const double aspect = double(scene.imageWidth) / scene.imageHeight;
    size_t seen = 0, emitting = 0, lit = 0;
    for (const SurfacePoint& point : surfaces.draw(kPoints)) {
        if (!isInView(scene.camera, aspect, point.position)) continue;
        ++seen;
        if (maxComponent(point.emission) > 0) {
            ++emitting;
            continue;
        }
        double radiance = 0;  // of white, irradiance/π
        for (const SurfacePoint& lamp : lamps) {
            const Vec3d d = point.position - lamp.position;
            const double squared = dot(d, d);
            if (!(squared > 0)) continue;
            const double out = dot(lamp.normal, d), in = std::abs(dot(point.normal, d));
            const double cosines = (lamp.emitsBothSides ? std::abs(out) : std::max(out, 0.0)) * in / squared;
            radiance += maxComponent(lamp.emission) * cosines / squared * emitters.area() /
                        (std::numbers::pi * double(lamps.size()));
        }
        lit += radiance >= worthMention;
    }
    return seen == 0 || 2 * emitting >= seen || 50 * lit >= seen;
}

}  // namespace antipode
