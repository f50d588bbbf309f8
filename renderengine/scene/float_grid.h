// What single precision does to positions: scenes far from the origin, small things in large ones.
#pragma once

#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

/// Where the scene should have its origin: along each axis the centre of its bounds, if that is more than two bounding
/// radii from zero, else zero. Surfaces move there without rounding: each coordinate is within a factor of two of the
/// centre's, and the difference of such floats is exact (Sterbenz).
Vec3f remoteCenter(const Scene& scene);

/// The scene with all positions moved by −origin.
Scene movedToOrigin(Scene scene, const Vec3f& origin);

/// One sentence for each thing that a scene's floats cannot show well: positions that are rounded by a visible part of a
/// pixel, and the object whose shape suffers most where that is more than a thousandth of its size.
std::vector<std::string> precisionNotices(const Scene& scene);

}  // namespace antipode
