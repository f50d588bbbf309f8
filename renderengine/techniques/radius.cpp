#include <algorithm>
#include <cmath>

#include "gpu/camera_pilot.h"
#include "gpu/packed_scene.h"
#include "kernels/shared/layout.h"
#include "renderengine/engine.h"
#include "techniques/technique.h"

namespace antipode {
namespace {

/// Merging within the pixels of a smaller image would blur over a visible part of the picture.
constexpr double fewestRows = 256;

/// The width of a pixel where the camera looks: so wide that a quarter of all pilot paths ends nearer. Neither a leaf
/// before the lens nor what lies behind the nearer half of the picture moves it: a plain that reaches to the horizon
/// and the background that would be there without it are the same. Where less than half of the picture shows
/// anything, the median of what it shows; the two meet at one half.
std::optional<double> seenPixelWidth(const Scene& scene, double aspectRatio, double rows) {
    PilotPaths seen = tracePilotPaths(scene, aspectRatio);
    std::vector<double>& heights = seen.pictureHeights;
    if (heights.empty()) return {};
    const size_t rank = std::min<size_t>(seen.paths / 4, heights.size() / 2);
    std::nth_element(heights.begin(), heights.begin() + std::ptrdiff_t(rank), heights.end());
    return heights[rank] / rows;
}

/// Where nothing is seen on which vertices merge, and where nothing merges at all: the smaller of a pixel's width at
/// the scene's distance and 1/200 of its bounding radius.
double widthByBounds(const Scene& scene, double rows) {
    const Bounds3f bounds = tracedBounds(scene);
    const double radius = bounds.radius();
    const double distance = std::max(length(Vec3d(scene.camera.position) - Vec3d(bounds.center())), radius);
    const double parallel = scene.camera.orthographicHeight;
    const double height = parallel > 0 ? parallel : distance * 2.0 * std::tan(0.5 * double(scene.camera.verticalFov));
    return std::min(height / rows, radius / 200.0);
}

}  // namespace

double initialRadius(const Scene& scene, const RenderSettings& settings) {
    if (settings.initialRadius) return *settings.initialRadius;
    const double aspectRatio = double(settings.width) / settings.height, rows = settings.height;
    std::optional<double> width;
    if (planTechnique(settings).terms & shared::TERM_MERGE)
        width = seenPixelWidth(scene, aspectRatio, std::max(rows, fewestRows));
    return settings.radiusFactor * (width ? *width : widthByBounds(scene, rows));
}

double mergeRadius(double initialRadius, double alpha, uint64_t iteration) {
    return initialRadius * std::pow(double(iteration), 0.5 * (alpha - 1.0));
}

}  // namespace antipode
