// An image with less noise, made from what a film tells of its noise and of the surfaces in it.
#pragma once

#include "renderengine/film.h"

namespace antipode {

/// The layers that denoise() needs beside the image.
inline constexpr LayerSet denoiserLayers{LayerKind::Albedo, LayerKind::Normal, LayerKind::Depth, LayerKind::Coverage};

struct Denoised {
    Image image;
    bool openImageDenoise = false;  ///< whether it was among the filters
};

/// The film's image, denoised only where that makes it more accurate.
///
/// Candidates are local linear regressions of radiance on albedo, normal and depth in windows of 17² pixels, after
/// Bitterli et al., "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings", CGF 35(4),
/// 2016, and, where the machine has it and `openImageDenoise` allows it, Intel's Open Image Denoise. The film's classes
/// of iterations are parted into two halves: each is filtered (regressions with weights that the other half tells:
/// non-local means, Rousselle, Knaus and Zwicker, "Adaptive Rendering with Non-Local Means Filtering", TOG 31(6), 2012)
/// and is then held against the other half, whose noise is not its own. That tells without bias how far the filtered
/// half is off, blur included. The image itself is one more candidate, whose error its classes tell. All are averaged
/// by the inverse of their errors; so a caustic that the iterations have resolved stays, and with more and more
/// iterations the result approaches the image.
///
/// Takes some 20 microseconds a pixel and core. Throws Error(Usage) where fewer than two classes have iterations, or a
/// layer of denoiserLayers is missing.
Denoised denoise(const FilmSums& sums, bool openImageDenoise = true);

}  // namespace antipode
