#include "scene/precision_notices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "scene/bounds.h"

namespace antipode {
namespace {

// Of a pixel, of an object's size: what nobody sees.
constexpr double invisiblePixels = 0.1, invisibleShare = 1e-3;
// Of the smallest object: a shadow's border is moved by that, to either side.
constexpr double tolerableShare = 1e-2;

double farthestCoordinate(const Bounds3d& bounds) {
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis)
        farthest = std::max({farthest, std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis])});
    return farthest;
}

/// How far a position within the bounds may lie from where it was meant: half the spacing of floats.
double rounding(const Bounds3d& bounds) {
    const auto farthest = float(farthestCoordinate(bounds));
    return 0.5 * (double(std::nextafter(farthest, std::numeric_limits<float>::infinity())) - double(farthest));
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
            Bounds3d bounds;
            for (const uint32_t i : t) bounds.add(Vec3d(mesh.positions[i]));
            largest = std::max(largest, 2 * bounds.radius());
        }
    forEachObject(scene, [&](const Bounds3d& bounds, const std::string& name) {
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

std::vector<std::string> precisionNotices(const Scene& scene) {
    std::vector<std::string> notices;
    const Bounds3d all = boundsOf(scene);
    const double distance = std::max(length(Vec3d(scene.camera.position) - all.center()), all.radius());
    const double parallel = scene.camera.orthographicHeight;
    const double pixel =
        (parallel > 0 ? parallel : 2 * distance * std::tan(0.5 * double(scene.camera.verticalFov))) / scene.imageHeight;
    if (rounding(all) > invisiblePixels * pixel)
        notices.push_back("the scene reaches " + rounded(farthestCoordinate(all)) +
                          " units from the origin, where positions are rounded by up to " + rounded(rounding(all)) +
                          " units, or " + rounded(rounding(all) / pixel) +
                          " pixels; move it closer to the origin before it is written");

    double worst = invisibleShare;
    std::string worstObject;
    const auto consider = [&](const Bounds3d& bounds, const std::string& name) {
        const double share = rounding(bounds) / bounds.radius();
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
