// The image's error and its interval, pooled over pixels.
#include "renderengine/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "film/class_contrasts.h"
#include "film/relative_weights.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

constexpr uint32_t tilesPerSide = 8;                  // a multiple of 2
constexpr double normalQuantile = 1.959963984540054;  // of 97.5 %
constexpr double burstDegrees = 1000;                 // as good as normal

/// Student's quantile of 97.5 % (Cornish-Fisher expansion: Abramowitz & Stegun 1964, 26.7.5).
double studentQuantile(double degreesOfFreedom) {
    const double z = normalQuantile, n = degreesOfFreedom;
    const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

using Tile = std::array<double, ClassContrasts::most>;  ///< of each contrast, the tile's part of relMSE

struct Spread {
    double variance = 0, degreesOfFreedom = 1;
};

/// Of the relMSE that one contrast tells. Tiles are independent; within a tile its contrasts are repetitions.
Spread spreadOf(const std::vector<Tile>& tiles, uint32_t contrasts) {
    double sum = 0, squares = 0;
    for (const Tile& tile : tiles) {
        const double mean = std::accumulate(tile.begin(), tile.begin() + contrasts, 0.0) / contrasts;
        double variance = 0;
        for (uint32_t j = 0; j < contrasts; ++j) variance += (tile[j] - mean) * (tile[j] - mean);
        // One contrast alone: E[t²] = 3·E[t]² where the whole tile errs alike, and 2/3 of it is variance.
        variance = contrasts > 1 ? variance / (contrasts - 1) : mean * mean * 2 / 3;
        sum += variance;
        squares += variance * variance;
    }
    // An estimate of f degrees of freedom has E[s⁴] = σ⁴·(1 + 2/f).
    const double perTile = std::max(contrasts - 1, 1u);
    return {sum, squares > 0 ? std::max(sum * sum * (perTile + 2) / squares, 2.0) : 2.0};
}

/// The tiles in blocks of 2×2.
std::vector<Tile> inFours(const std::vector<Tile>& tiles) {
    std::vector<Tile> fours(tiles.size() / 4);
    for (uint32_t i = 0; i < tiles.size(); ++i) {
        Tile& four = fours[i / tilesPerSide / 2 * (tilesPerSide / 2) + i % tilesPerSide / 2];
        for (size_t j = 0; j < four.size(); ++j) four[j] += tiles[i][j];
    }
    return fours;
}

/// Of the relMSE that one contrast tells, where what neighbours share across the borders of tiles counts, too: it takes
/// from the variance in proportion to the borders' length, which halves from tiles to fours.
Spread spreadWithoutBorders(const std::vector<Tile>& tiles, uint32_t contrasts) {
    const Spread fine = spreadOf(tiles, contrasts), coarse = spreadOf(inFours(tiles), contrasts);
    if (contrasts == 1 || coarse.variance <= fine.variance) return fine;
    return {2 * coarse.variance - fine.variance, coarse.degreesOfFreedom};
}

uint32_t tileOf(const FilmLayout& layout, uint64_t pixel) {
    const uint64_t x = pixel % layout.width, y = pixel / layout.width;
    return uint32_t(y * tilesPerSide / layout.height * tilesPerSide + x * tilesPerSide / layout.width);
}

/// What pixels and tiles contribute to relMSE.
struct ErrorParts {
    double relMse = 0;
    double unconfirmed = 0;  ///< with weights that rare bright samples did not lessen (film/relative_weights.h)
    double bursts = 0;       ///< variance of relMSE by the number of rare samples that have come
    std::vector<float> pixels;
    std::vector<Tile> tiles = std::vector<Tile>(tilesPerSide * tilesPerSide);
};

ErrorParts errorParts(const FilmSums& sums, const ClassContrasts& contrasts) {
    ErrorParts parts;
    const RelativeWeights weights = relativeWeights(sums.layout, contrasts);
    const uint64_t pixels = sums.layout.pixels();
    const uint32_t count = contrasts.count();
    parts.pixels.resize(pixels);
    for (uint64_t p = 0; p < pixels; ++p) {
        Tile own{};
        double unconfirmed = 0;
        for (size_t i = 3 * p; i < 3 * (p + 1); ++i) {
            const ClassContrasts::Means means = contrasts.means(i);
            for (uint32_t j = 0; j < count; ++j) {
                const double contrast = contrasts.contrast(j, means);
                const double part = contrast * contrast / (3.0 * double(pixels));
                own[j] += part * weights.values[i];
                unconfirmed += part * weights.unconfirmed[i] / count;
            }
        }
        Tile& tile = parts.tiles[tileOf(sums.layout, p)];
        double mean = 0, variance = 0;
        for (uint32_t j = 0; j < count; ++j) tile[j] += own[j], mean += own[j] / count;
        for (uint32_t j = 0; j < count; ++j) variance += (own[j] - mean) * (own[j] - mean);
        parts.relMse += mean;
        parts.unconfirmed += unconfirmed;
        parts.pixels[p] = float(mean);
        // Where one class has met a rare sample all contrasts are equal: their spread does not show that it might not
        // have come. Of a normal distribution both terms have the same mean.
        if (count > 1) parts.bursts += mean * mean - variance / (count - 1) * (1 + 2.0 / count) / 2;
    }
    return parts;
}

/// How the squared error is spread over the pixels.
void describePixels(std::vector<float> errors, ErrorEstimate& estimate) {
    std::ranges::sort(errors, std::greater());
    const double total = std::accumulate(errors.begin(), errors.end(), 0.0);
    const double pixels = double(errors.size());
    const auto hundredth = errors.begin() + ptrdiff_t(std::max<size_t>(errors.size() / 100, 1));
    estimate.worstShare = std::accumulate(errors.begin(), hundredth, 0.0) / total;
    double sum = 0;
    while (sum < total / 2 && estimate.halfPixels < errors.size()) sum += errors[estimate.halfPixels++];
    estimate.halfShare = double(estimate.halfPixels) / pixels;
    // Hill (1975), over as many of the largest as Vehtari et al. (2024) take.
    const size_t tail = std::min(errors.size() / 5, size_t(3 * std::sqrt(pixels)));
    if (tail == 0) return;
    double logarithms = 0;
    for (size_t i = 0; i < tail && errors[tail] > 0; ++i) logarithms += std::log(errors[i] / errors[tail]);
    estimate.tailIndex = errors[tail] > 0 ? logarithms / double(tail) : std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<ErrorEstimate> estimateError(const FilmSums& sums) {
    const ClassContrasts contrasts(sums);
    if (contrasts.classes() < 2) return std::nullopt;
    const ErrorParts parts = errorParts(sums, contrasts);
    ErrorEstimate estimate;
    estimate.iterations = sums.iterations;
    estimate.percent = estimate.low = estimate.high = 100 * std::sqrt(parts.relMse);
    if (parts.relMse == 0) return estimate;
    const uint32_t count = contrasts.count();
    const Spread spread = spreadWithoutBorders(parts.tiles, count);
    const double told = spread.variance * (1 + 1.0 / count), bursts = std::max(parts.bursts, 0.0);
    // Satterthwaite's; bursts are counted over all pixels.
    const double degrees = bursts > 0 ? (told + bursts) * (told + bursts) /
                                            (told * told / spread.degreesOfFreedom + bursts * bursts / burstDegrees)
                                      : spread.degreesOfFreedom;
    const double readings = std::log(parts.unconfirmed / parts.relMse);
    const double logVariance = std::log1p((told + bursts) / (parts.relMse * parts.relMse)) + readings * readings / 2;
    const double factor = std::exp(studentQuantile(degrees) * std::sqrt(logVariance) / 2);
    estimate.low /= factor;
    estimate.high *= factor;
    describePixels(parts.pixels, estimate);
    return estimate;
}

namespace {

ClassContrasts atLeastTwoClasses(const FilmSums& sums) {
    ClassContrasts contrasts(sums);
    if (contrasts.classes() < 2)
        throw Error(ErrorCode::Usage, "An image in fewer than two classes of iterations tells no error.");
    return contrasts;
}

}  // namespace

std::vector<float> standardErrors(const FilmSums& sums) {
    const ClassContrasts contrasts = atLeastTwoClasses(sums);
    std::vector<float> errors(sums.layout.offset(1));
    for (size_t i = 0; i < errors.size(); ++i) errors[i] = float(std::sqrt(contrasts.variance(contrasts.means(i))));
    return errors;
}

std::vector<float> relativeStandardErrors(const FilmSums& sums) {
    std::vector<float> errors = errorParts(sums, atLeastTwoClasses(sums)).pixels;
    for (float& error : errors) error = std::sqrt(error * float(errors.size()));
    return errors;
}

}  // namespace antipode
