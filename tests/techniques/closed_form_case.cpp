#include "tests/techniques/closed_form_case.h"

#include <cmath>
#include <numbers>

#include "support/reference/camera.h"

namespace antipode::test {

RenderSettings settingsOf(const ClosedFormCase& c) {
    RenderSettings settings;
    settings.width = settings.height = c.size;
    settings.seed = 7;
    settings.lightPathCount = c.lightPaths;
    settings.minPathLength = c.minPathLength;
    settings.maxPathLength = c.maxPathLength;
    settings.initialRadius = c.mergeRadius;
    settings.alpha = 1;
    return settings;
}

ExpectedBlock expectedOf(const ClosedFormCase& c, double left, double top, double right, double bottom) {
    constexpr int steps = 48, directions = 8;
    const reference::PinholeCamera camera(c.scene.camera, c.size, c.size);
    const double circle = c.mergeRadius / std::numbers::sqrt2;
    double sum = 0, merged = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const reference::Ray ray =
                camera.ray(left + (right - left) * (i + 0.5) / steps, top + (bottom - top) * (j + 0.5) / steps);
            const Vec3d at = ray.origin + ray.direction * ((c.planeHeight - ray.origin.z) / ray.direction.z);
            sum += c.radiance(at.x, at.y);
            for (int k = 0; k < directions; ++k) {
                const double angle = 2 * std::numbers::pi * (k + 0.5) / directions;
                merged += c.radiance(at.x + circle * std::cos(angle), at.y + circle * std::sin(angle)) / directions;
            }
        }
    const double count = double(steps) * steps;
    return {sum / count, (std::abs(merged - sum) + c.otherMergeBias * sum) / count};
}

}  // namespace antipode::test
