// What single precision does to positions: scenes far from the origin, very large or very small ones, small things in
// large ones.
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

/// Half the diagonal of the surfaces' bounds, in scene units.
double boundingRadius(const Scene& scene);

/// By which power of two the lengths of a valid scene should be multiplied to be rendered: 0 for bounding radii from
/// 2^-16 to 2^17, else what brings the radius between 1 and 2. Kernels take fourth powers of lengths, which floats hold
/// from 1e-9 to 1e9.
int unitExponent(const Scene& scene);

/// The scene with all lengths × 2^exponent, which rounds nothing, and intensities such that irradiances stay. Throws
/// Error(Input) where an intensity, or the place of a light or of the camera, leaves the range of floats.
Scene inUnits(Scene scene, int exponent);

/// One sentence for each thing that a scene's floats cannot show well: positions that are rounded by a visible part of
/// a pixel, the object whose shape suffers most where that is more than a thousandth of its size, and triangles so
/// large that hits on them are rounded by more than a hundredth of the smallest object.
std::vector<std::string> precisionNotices(const Scene& scene);

}  // namespace antipode
