// The denoiser's candidates: radiance as a local linear function of features.
#pragma once

#include <array>

#include "denoise/halves.h"

namespace antipode {

/// How unlike neighbours may be, in units of their noise: a narrow kernel for what is sharp, a wide one for what is
/// smooth (k of non-local means).
inline constexpr std::array<float, 2> kernelWidths{0.5F, 1};

/// Of one half of a film, by kernel width.
using Filtered = std::array<RgbPlanes, kernelWidths.size()>;

/// Filters `half` by weights that `other` tells. At each pixel: the value there of the weighted least squares fit of
/// radiance to features over the pixel's window, ridged so that what features hardly vary by explains nothing.
Filtered filtered(const Half& half, const Half& other, const Features& features);

}  // namespace antipode
