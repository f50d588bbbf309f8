#include "support/reference/camera.h"

#include <cmath>

#include "renderengine/error.h"

namespace antipode::reference {

PinholeCamera::PinholeCamera(const Camera& camera, uint32_t width, uint32_t height)
    : position_(camera.position),
      forward_(normalize(Vec3d(camera.forward))),
      width_(width),
      height_(height),
      planeDistance_(height / (2 * std::tan(camera.verticalFov / 2.0))) {
    if (camera.lensRadius != 0) throw Error(ErrorCode::Usage, "The reference renderer has only a pinhole camera.");
    right_ = normalize(cross(forward_, Vec3d(camera.up)));
    up_ = cross(right_, forward_);
}

Ray PinholeCamera::ray(double x, double y) const {
    const Vec3d direction = forward_ * planeDistance_ + right_ * (x - width_ / 2) + up_ * (height_ / 2 - y);
    return {position_, normalize(direction)};
}

double PinholeCamera::pdf(const Vec3d& direction) const {
    const double cosine = dot(direction, forward_);
    return cosine > 0 ? planeDistance_ * planeDistance_ / (cosine * cosine * cosine) : 0;
}

}  // namespace antipode::reference
