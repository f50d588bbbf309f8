// Images as bytes in memory: PNG and JPEG files, half floats.
#pragma once

#include <string>
#include <vector>

#include "renderengine/film.h"

namespace antipode {

/// What writePng() writes: through the tone curve, 8-bit sRGB.
std::string encodePng(const Image& image);
/// The same in 16 bits.
std::string encodePng16(const Image& image);
/// The same as writePng() as a JPEG of this quality, 1 to 100, its colours at full resolution. Throws Error(Output).
std::string encodeJpeg(const Image& image, int quality);

/// The image × `factor` as width·height·3 little-endian binary16, rounded to nearest; what is beyond 65504 is infinite.
std::string encodeHalfRgb(const Image& image, double factor);

/// √ of the mean over channels of (a−b)²/(b²+ε) of each pixel, row-major: the pixel's part of √relMSE. NaN where either
/// is not finite. Throws Error(Usage) where sizes differ.
std::vector<float> relativeErrors(const Image& a, const Image& b);

/// Values as colours on a logarithmic scale, black at `low` and below, over purple and orange to pale yellow at `high`
/// and above (the "inferno" map of Smith and van der Walt, which stays readable in grey and to the colour-blind).
/// Magenta where a value is not finite. Throws Error(Usage) unless there are width·height values.
std::string encodeErrorMap(uint32_t width, uint32_t height, const std::vector<float>& values, double low, double high);

/// What error maps of relative errors span: 0.1 % to 100 %.
inline constexpr double errorMapLow = 1e-3, errorMapHigh = 1;

}  // namespace antipode
