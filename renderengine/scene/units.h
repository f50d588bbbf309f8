// Very large and very small scenes, in units in which floats hold what kernels compute.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// Half the diagonal of the surfaces' bounds, in scene units.
double boundingRadius(const Scene& scene);

/// By which power of two the lengths of a valid scene should be multiplied to be rendered: 0 for bounding radii from
/// 2^-16 to 2^17, else what brings the radius between 1 and 2. Kernels take fourth powers of lengths, which floats hold
/// from 1e-9 to 1e9.
int unitExponent(const Scene& scene);

/// The scene with all lengths × 2^exponent, which rounds nothing, and intensities such that irradiances stay. Throws
/// Error(Input) where an intensity, or the place of a light or of the camera, leaves the range of floats.
Scene inUnits(Scene scene, int exponent);

}  // namespace antipode
