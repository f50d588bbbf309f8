#include "scene/float_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "renderengine/error.h"

namespace antipode {
namespace {

// Of a pixel, of an object's size: what nobody sees.
constexpr double invisiblePixels = 0.1, invisibleShare = 1e-3;
// Of the smallest object: a shadow's border is moved by that, to either side.
constexpr double tolerableShare = 1e-2;

struct Bounds {
    Vec3d least{std::numeric_limits<double>::infinity()}, greatest{-std::numeric_limits<double>::infinity()};

    void add(const Vec3d& p) {
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = std::min(least[axis], p[axis]);
            greatest[axis] = std::max(greatest[axis], p[axis]);
        }
    }
    void add(const Bounds& other) { add(other.least), add(other.greatest); }
    Vec3d center() const { return (least + greatest) * 0.5; }
    double radius() const { return 0.5 * length(greatest - least); }
    double farthestCoordinate() const {
        double farthest = 0;
        for (int axis = 0; axis < 3; ++axis)
            farthest = std::max({farthest, std::abs(least[axis]), std::abs(greatest[axis])});
        return farthest;
    }
    /// How far a position may lie from where it was meant: half the spacing of floats.
    double rounding() const {
        const auto farthest = float(farthestCoordinate());
        return 0.5 * (double(std::nextafter(farthest, std::numeric_limits<float>::infinity())) - double(farthest));
    }
};

Bounds boundsOf(const Mesh& mesh) {
    Bounds bounds;
    for (const Vec3f& p : mesh.positions) bounds.add(Vec3d(p));
    return bounds;
}

Bounds boundsOf(const Sphere& sphere) {
    Bounds bounds;
    bounds.add(Vec3d(sphere.center) - Vec3d(sphere.radius));
    bounds.add(Vec3d(sphere.center) + Vec3d(sphere.radius));
    return bounds;
}

Bounds boundsOf(const Scene& scene) {
    Bounds bounds;
    for (const Mesh& mesh : scene.meshes) bounds.add(boundsOf(mesh));
    for (const Sphere& sphere : scene.spheres) bounds.add(boundsOf(sphere));
    return bounds;
}

std::string rounded(double value) {
    std::ostringstream text;
    text.precision(2);
    text << value;
    return text.str();
}

/// Calls visit(bounds, name) for every mesh and sphere.
template <class Visit>
void forEachObject(const Scene& scene, const Visit& visit) {
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const std::string& name = scene.meshes[i].name;
        visit(boundsOf(scene.meshes[i]), name.empty() ? "mesh #" + std::to_string(i) : "mesh '" + name + "'");
    }
    for (size_t i = 0; i < scene.spheres.size(); ++i) visit(boundsOf(scene.spheres[i]), "sphere #" + std::to_string(i));
}

/// A hit's position is a weighted mean of its triangle's corners, and as far off as floats of the triangle's size.
void addHugeBesideTiny(const Scene& scene, std::vector<std::string>& notices) {
    double largest = 0, smallest = std::numeric_limits<double>::infinity();
    std::string smallestObject;
    for (const Mesh& mesh : scene.meshes)
        for (const auto& t : mesh.triangles) {
            Bounds bounds;
            for (const uint32_t i : t) bounds.add(Vec3d(mesh.positions[i]));
            largest = std::max(largest, 2 * bounds.radius());
        }
    forEachObject(scene, [&](const Bounds& bounds, const std::string& name) {
        if (bounds.radius() < smallest) smallest = bounds.radius(), smallestObject = name;
    });
    const double error = 0x1p-24 * largest;
    if (error > tolerableShare * smallest)
        notices.push_back("the largest triangle measures " + rounded(largest) +
                          " units, and in single precision hits on it are rounded by up to " + rounded(error) +
                          " units, " + rounded(100 * error / smallest) + " % of the radius of " + smallestObject +
                          "; divide it, or render with --precision double");
}

}  // namespace

Vec3f remoteCenter(const Scene& scene) {
    const Bounds bounds = boundsOf(scene);
    Vec3f center;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(bounds.center()[axis]) > 2 * bounds.radius()) center[axis] = float(bounds.center()[axis]);
    return center;
}

Scene movedToOrigin(Scene scene, const Vec3f& origin) {
    const auto move = [&](Vec3f& p) { p = Vec3f(Vec3d(p) - Vec3d(origin)); };
    for (Mesh& mesh : scene.meshes) std::for_each(mesh.positions.begin(), mesh.positions.end(), move);
    for (Sphere& sphere : scene.spheres) move(sphere.center);
    for (PointLight& light : scene.pointLights) move(light.position);
    for (SpotLight& light : scene.spotLights) move(light.position);
    move(scene.camera.position);
    return scene;
}

double boundingRadius(const Scene& scene) { return boundsOf(scene).radius(); }

int unitExponent(const Scene& scene) {
    const int exponent = std::ilogb(boundingRadius(scene));
    return std::abs(exponent) <= 16 ? 0 : -exponent;
}

Scene inUnits(Scene scene, int exponent) {
    const auto inRange = [&](bool holds, const char* what) {
        if (!holds)
            throw Error(ErrorCode::Input, "scene '" + scene.name + "': measured by the scene's size, " + what +
                                              " lies outside single precision; write the scene in other units");
    };
    const auto scale = [&](float& length) {
        length = std::ldexp(length, exponent);
        inRange(std::isfinite(length), "the position of a light or of the camera, or its lens,");
    };
    const auto scaleAll = [&](Vec3f& p) { scale(p.x), scale(p.y), scale(p.z); };
    const auto intensify = [&](Vec3f& intensity) {
        for (int axis = 0; axis < 3; ++axis) {
            if (intensity[axis] == 0) continue;
            intensity[axis] = std::ldexp(intensity[axis], 2 * exponent);
            inRange(std::isnormal(intensity[axis]), "the intensity of a light");
        }
    };
    for (Mesh& mesh : scene.meshes) std::for_each(mesh.positions.begin(), mesh.positions.end(), scaleAll);
    for (Sphere& sphere : scene.spheres) scaleAll(sphere.center), scale(sphere.radius);
    for (PointLight& light : scene.pointLights) scaleAll(light.position), intensify(light.intensity);
    for (SpotLight& light : scene.spotLights) scaleAll(light.position), intensify(light.intensity);
    scaleAll(scene.camera.position);
    scale(scene.camera.focusDistance);
    scale(scene.camera.lensRadius);
    return scene;
}

std::vector<std::string> precisionNotices(const Scene& scene) {
    std::vector<std::string> notices;
    const Bounds all = boundsOf(scene);
    const double distance = std::max(length(Vec3d(scene.camera.position) - all.center()), all.radius());
    const double pixel = 2 * distance * std::tan(0.5 * double(scene.camera.verticalFov)) / scene.imageHeight;
    if (all.rounding() > invisiblePixels * pixel)
        notices.push_back("the scene reaches " + rounded(all.farthestCoordinate()) +
                          " units from the origin, where positions are rounded by up to " + rounded(all.rounding()) +
                          " units, or " + rounded(all.rounding() / pixel) +
                          " pixels; move it closer to the origin before it is written");

    double worst = invisibleShare;
    std::string worstObject;
    const auto consider = [&](const Bounds& bounds, const std::string& name) {
        const double share = bounds.rounding() / bounds.radius();
        if (share > worst) worst = share, worstObject = name;
    };
    forEachObject(scene, consider);
    if (!worstObject.empty())
        notices.push_back(worstObject +
                          " is so small and so far from the origin that rounding moves its surface by up to " +
                          rounded(100 * worst) + " % of its radius");
    addHugeBesideTiny(scene, notices);
    return notices;
}

}  // namespace antipode
