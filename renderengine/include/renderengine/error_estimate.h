// How wrong an image still is, told from the image's own residue classes: no reference is needed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderengine/film.h"

namespace antipode {

/// ε of relMSE = mean over pixels and channels of (x−ref)²/(ref²+ε): part of the measure's definition, not a tolerance.
inline constexpr double relativeErrorEpsilon = 0.01;

/// What merging blurs, √relMSE in percent.
struct MergeBias {
    double percent = 0;        ///< what of it is more than noise makes believe; counted in the whole error
    double low = 0, high = 0;  ///< hold it in 95 of 100 renders, be the light smooth or full of borders

    /// Whether it is more than noise might make it. Where it is not, all that is known is that it is below `high`.
    bool told() const { return low > 0; }
};

/// Errors are √relMSE in percent (see relativeErrorEpsilon).
struct ErrorEstimate {
    uint64_t iterations = 0;
    double percent = 0;        ///< noise and bias: the root of their squares' sum
    double low = 0, high = 0;  ///< hold the error of this very image in 95 of 100 renders
    double worstShare = 0;     ///< share of the squared noise that the worst hundredth of the pixels holds
    double halfShare = 0;      ///< the smallest share of the pixels that holds half of the squared noise
    /// The largest squared errors of pixels fall off as x^(−1/tailIndex); infinite where few pixels err at all. From 1
    /// on their mean would be without bound: what is still to come may be more than all that came.
    double tailIndex = 0;
    uint64_t halfPixels = 0;             ///< how many pixels halfShare is of
    double noisePercent = 0;             ///< noise alone
    std::optional<MergeBias> bias = {};  ///< where the film has a layer that tells it

    /// Whether rare bright samples make it, so that it may be larger and the interval too narrow. A little above 1,
    /// since an eighth of the pixels that is four times as noisy as the others has an index of 0.95 ± 0.1.
    bool doubtful() const { return tailIndex >= 1.2 || (halfPixels > 0 && halfPixels <= 5); }
};

/// The error of the mean image: its noise from the spread of its classes, which are independent images of one
/// expectation, and how far that is off by merging from the film's blur layer, where it has one (film/bias_estimate.h).
///
/// Unequal numbers of iterations are allowed; a class of none is left out. Between K classes there are K − 1
/// independent differences, each of which has the variance that the error of the mean has. The denominator, for want of
/// a reference, is taken from those classes that a difference is not of, so that a bright outlier does not excuse
/// itself, and from neighbours and values alike where those are noise (film/relative_weights.h).
///
/// The interval is one of prediction, for the error that was made and not for its mean, log-normal, by Student's
/// quantile (Satterthwaite 1946). Its variance is the sum of three: by exchange of the error with the K − 1
/// differences, from their spread within each of 8×8 tiles of the image, which sees what neighbours share within a tile
/// and across its borders, and takes blocks of 2×2 tiles for independent; of the number of rare bright samples that
/// have come, which all differences share; and of how far it matters whether brightness that one class alone has met is
/// believed. With two classes there is one difference, and the interval is that of tiles that err as a whole: too wide.
///
/// What it cannot see: light that no path has found yet, and what the arithmetic itself gets wrong. How often it
/// is right: docs/accuracy/calibration.md. Nothing where fewer than two classes have iterations.
std::optional<ErrorEstimate> estimateError(const FilmSums& sums);

/// The standard error of the mean of each pixel and channel, row-major; of few degrees of freedom each (classes − 1).
/// Throws Error(Usage) where fewer than two classes have iterations.
std::vector<float> standardErrors(const FilmSums& sums);

/// The same of each pixel, relative to its brightness: the root of its mean square over the image is √relMSE.
std::vector<float> relativeStandardErrors(const FilmSums& sums);

/// How much brighter than the truth merging makes each pixel, in luminance, where there is a blur layer, and 0
/// elsewhere: smoothed, since a pixel alone tells mostly noise. Throws Error(Usage) where fewer than two classes have
/// iterations.
std::vector<float> mergeBias(const FilmSums& sums);

}  // namespace antipode
