#include <cmath>

#include "gpu/packed_scene.h"
#include "renderengine/engine.h"

namespace antipode {

double initialRadius(const Scene& scene, const RenderSettings& settings) {
    if (settings.initialRadius) return *settings.initialRadius;
    const Bounds3f bounds = tracedBounds(scene);
    const double radius = bounds.radius();
    const double distance = std::max(length(Vec3d(scene.camera.position) - Vec3d(bounds.center())), radius);
    const double pixelWidth = distance * 2.0 * std::tan(0.5 * double(scene.camera.verticalFov)) / settings.height;
    return settings.radiusFactor * std::min(pixelWidth, radius / 200.0);
}

double mergeRadius(double initialRadius, double alpha, uint64_t iteration) {
    return initialRadius * std::pow(double(iteration), 0.5 * (alpha - 1.0));
}

}  // namespace antipode
