// The reference pinhole camera.
#pragma once

#include "support/reference/geometry.h"

namespace antipode::reference {

class PinholeCamera {
public:
    /// Throws Error(Usage) for a camera with a lens.
    PinholeCamera(const Camera& camera, uint32_t width, uint32_t height);

    /// The ray through image position (x, y) in pixels: (0, 0) is the upper left corner of the image.
    Ray ray(double x, double y) const;
    /// Density of a direction from the camera per solid angle when the position in one pixel is uniform:
    /// (D/cosθ)²/cosθ with D the distance of the image plane in pixels. 0 behind the camera.
    double pdf(const Vec3d& direction) const;
    Vec3d position() const { return position_; }

private:
    Vec3d position_, right_, up_, forward_;
    double width_, height_, planeDistance_;
};

}  // namespace antipode::reference
