// What a film knows of its image, as the denoiser takes it.
#pragma once

#include <array>

#include "denoise/plane.h"
#include "renderengine/film.h"

namespace antipode {

using RgbPlanes = std::array<Plane, 3>;

/// How far windows reach beyond a pixel, and patches beyond a pixel of a window.
inline constexpr int32_t windowRadius = 8, patchRadius = 3, planeMargin = windowRadius + patchRadius;

/// Half of a film's iterations.
struct Half {
    RgbPlanes mean;
    RgbPlanes variance;  ///< of the mean, smoothed: a pixel's own has few degrees of freedom
    float share = 0;     ///< of all iterations
};

/// Two halves of a film's classes of iterations, which are independent of one another.
struct Halves {
    std::array<Half, 2> half;
    RgbPlanes mean;      ///< of all iterations
    RgbPlanes variance;  ///< of that mean, of as many degrees of freedom as there are classes, less one
};
/// Throws Error(Usage) where fewer than two classes have iterations.
Halves halvesOf(const FilmSums& sums);

/// What regressions explain radiance by, on scales on which a tenth is much: albedo, normal, and a depth that goes
/// to 1.
inline constexpr size_t featureCount = 7;
using Features = std::array<Plane, featureCount>;
/// Throws Error(Usage) where a layer is missing.
Features featuresOf(const FilmSums& sums);

}  // namespace antipode
