#include "proto/schema_camera.h"

#include <cmath>

#include "proto/schema_values.h"

namespace antipode {
namespace {

constexpr double fullFrameWidth = 36;  // mm
constexpr double millimetresPerUnit = 1000;

double positive(bool given, double value, double otherwise, const char* where) {
    if (!given) return otherwise;
    if (!(value > 0) || !std::isfinite(value)) failAt(where, "must be a number above 0");
    return value;
}

/// The lens as photographers give it; where an angle is given, too, the f-stop is of the focal length that has it.
void readLens(const schema::Camera& from, double aspectRatio, Camera& camera) {
    const double sensorHeight =
        positive(from.has_sensor_width(), from.sensor_width(), fullFrameWidth, "camera: sensor_width") / aspectRatio;
    const double focalLength =
        positive(from.has_focal_length(), from.focal_length(),
                 0.5 * sensorHeight / std::tan(0.5 * double(camera.verticalFov)), "camera: focal_length");
    if (from.has_focal_length()) {
        if (from.has_vertical_fov()) failAt("camera", "needs either focal_length or vertical_fov, not both");
        camera.verticalFov = float(2 * std::atan(0.5 * sensorHeight / focalLength));
    }
    if (!from.has_f_stop()) return;
    if (from.lens_radius() != 0) failAt("camera", "needs either f_stop or lens_radius, not both");
    const double stop = positive(true, from.f_stop(), 0, "camera: f_stop");
    camera.lensRadius = float(0.5 * focalLength / stop / millimetresPerUnit);
}

}  // namespace

void readCamera(const schema::Camera& from, const ReadContext& context, double aspectRatio, Camera& camera) {
    readFields(from, "camera", context, camera);
    readLens(from, aspectRatio, camera);
    if (from.look_at_size() == 0) return;
    if (from.forward_size() > 0) failAt("camera", "needs either look_at or forward, not both");
    const Vec3d towards = Vec3d(readVec3(from.look_at(), "camera: look_at")) - Vec3d(camera.position);
    if (!(length(towards) > 0)) failAt("camera: look_at", "must differ from position");
    camera.forward = Vec3f(normalize(towards));
    if (!from.has_focus_distance()) camera.focusDistance = float(length(towards));
}

}  // namespace antipode
