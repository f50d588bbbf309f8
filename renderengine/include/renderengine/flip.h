// FLIP: how different two images look to someone who flips between them.
#pragma once

#include <vector>

#include "renderengine/film.h"

namespace antipode {

/// Pixels per degree of visual angle at which FLIP is evaluated: 0.7 m from a display 0.7 m and 3840 pixels wide, as
/// the paper's authors do.
inline constexpr double flipPixelsPerDegree = 0.7 * (3840 / 0.7) * 3.14159265358979323846 / 180;

/// LDR-FLIP of each pixel, row-major, in [0, 1]: 0 where no difference is seen. Symmetric. The images are compared as
/// the PNGs show them, through the tone curve, but not rounded to 8 bits; pixels that are not finite are magenta.
/// Throws Error(Usage) where sizes differ.
///
/// P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild. FLIP: A difference evaluator
/// for alternating images. Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020.
std::vector<float> flipErrors(const Image& a, const Image& b);

}  // namespace antipode
