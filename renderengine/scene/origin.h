// Scenes far from the origin, brought to it, where floats are fine.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// Where the scene should have its origin: along each axis the centre of its bounds, if that is more than two bounding
/// radii from zero, else zero. Surfaces move there without rounding: each coordinate is within a factor of two of the
/// centre's, and the difference of such floats is exact (Sterbenz).
Vec3f remoteCenter(const Scene& scene);

/// The scene with all positions moved by −origin.
Scene movedToOrigin(Scene scene, const Vec3f& origin);

}  // namespace antipode
