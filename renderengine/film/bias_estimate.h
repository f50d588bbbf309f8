// What merging blurs, from two estimates of one density: with all light vertices within r, and with those in the inner
// half of the disk's area, each counted twice.
#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "renderengine/film.h"

namespace antipode {

/// A film's blur layer has, per pixel, D = all of the disk − its inner half, in luminance, of the same light vertices
/// with the same weights. Both estimates have one expectation but for their bias, whatever radii the iterations had.
/// Where the light is smooth that goes with the disk's area A = πr² (the second derivative of the irradiance: Silverman
/// 1986, 4.3.1), and the image's bias is twice E[D]; at the borders of shadows and surfaces it goes with √A, and is
/// 1/(1 − 1/√2) = 3.4 times E[D]. What is told lies between, at √2 and 0.83 of them; intervals reach to both.
inline constexpr double smoothBiasPerBlur = 2, borderBiasPerBlur = 2 + std::numbers::sqrt2;
inline constexpr double biasPerBlur = 2 * std::numbers::sqrt2;

/// The square of a bias that is biasPerBlur·E[D], as a part of relMSE.
struct SquaredBias {
    double value = 0;  ///< unbiased, and so below 0 now and then
    double standardError = 0;
    double low = 0, high = 0;  ///< its 95 % interval

    /// What part of the value is more than noise, by the positive part of James and Stein's factor.
    double credible() const;
};

/// Of the mean image. `weights` takes the square of a pixel's luminance to its part of relMSE, times the number of
/// pixels (film/relative_weights.h).
///
/// The square of a pixel's mean D is that of its expectation and the variance of the mean; the K − 1 contrasts between
/// the classes have that variance, too, and what they have on average is taken off: so the products of different
/// classes are what is left, and noise adds nothing to the mean. A sample that one class alone has met adds nothing at
/// all. The interval is Student's: its variance is told by how far the contrasts' squares differ, tile by tile
/// (film/tile_spread.h), and by products of the classes' means with what other classes differ by. Nothing where fewer
/// than two classes have iterations or the film has no blur.
std::optional<SquaredBias> squaredBias(const FilmSums& sums, std::span<const float> weights);

}  // namespace antipode
