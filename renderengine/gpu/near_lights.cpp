#include "gpu/near_lights.h"

#include <algorithm>
#include <cmath>

#include "numerics/bounds.h"
#include "scene/scene_fields.h"

namespace antipode {
namespace {

double squaredDistance(const Bounds3f& box, const Vec3d& p) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double outside = std::max({0.0, double(box.lower[axis]) - p[axis], p[axis] - double(box.upper[axis])});
        sum += outside * outside;
    }
    return sum;
}

/// The point of the segment from a to b that is nearest to the origin.
Vec3d nearestOnSegment(const Vec3d& a, const Vec3d& b) {
    const Vec3d along = b - a;
    const double squared = dot(along, along);
    return squared > 0 ? a + along * std::clamp(-dot(a, along) / squared, 0.0, 1.0) : a;
}

/// The greatest cosθ/d² on a triangle seen from the origin: with the height h of its plane h/d³, so at the nearest
/// point.
double greatestOnTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d normal = cross(b - a, c - a);
    const double size = length(normal);
    if (!(size > 0)) return 0;
    const Vec3d n = normal * (1 / size);
    const double height = dot(a, n);
    const Vec3d foot = n * height;
    const bool inside = dot(cross(b - a, foot - a), n) >= 0 && dot(cross(c - b, foot - b), n) >= 0 &&
                        dot(cross(a - c, foot - c), n) >= 0;
    double distance = std::abs(height);
    if (!inside)
        distance =
            std::min({length(nearestOnSegment(a, b)), length(nearestOnSegment(b, c)), length(nearestOnSegment(c, a))});
    // A light in the plane lights nothing of it.
    return height != 0 ? std::abs(height) / (distance * distance * distance) : 0;
}

class Search {
public:
    Search(const Scene& scene, double least) : scene_(scene), greatest_(least) {
        for (const Mesh& mesh : scene.meshes) {
            Bounds3f& box = meshBoxes_.emplace_back();
            for (const Vec3f& p : mesh.positions) box.add(p);
        }
    }

    void add(const Vec3f& position, const Vec3f& intensity) {
        const Vec3d p(position);
        const double brightest = maxComponent(intensity);
        for (size_t m = 0; m < scene_.meshes.size(); ++m) {
            if (!mayExceed(meshBoxes_[m], p, brightest)) continue;
            const Mesh& mesh = scene_.meshes[m];
            for (const auto& t : mesh.triangles) {
                const Vec3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
                Bounds3f box;
                box.add(a), box.add(b), box.add(c);
                if (mayExceed(box, p, brightest))
                    greatest_ =
                        std::max(greatest_, brightest * greatestOnTriangle(Vec3d(a) - p, Vec3d(b) - p, Vec3d(c) - p));
            }
        }
        for (const Sphere& s : scene_.spheres) {
            const double distance = std::abs(length(Vec3d(s.center) - p) - double(s.radius));
            if (distance > 0) greatest_ = std::max(greatest_, brightest / (distance * distance));
        }
    }

    double greatest() const { return greatest_; }

private:
    bool mayExceed(const Bounds3f& box, const Vec3d& p, double brightest) const {
        return brightest > greatest_ * squaredDistance(box, p);
    }

    const Scene& scene_;
    std::vector<Bounds3f> meshBoxes_;
    double greatest_;
};

}  // namespace

double brightestSpot(const Scene& scene, double least) {
    Search search(scene, least);
    forEachLight(scene, [&](const auto& light) {
        if constexpr (requires { light.intensity; }) search.add(light.position, light.intensity);
    });
    return search.greatest();
}

}  // namespace antipode
