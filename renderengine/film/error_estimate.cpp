// The image's error and its interval, pooled over pixels.
#include "renderengine/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "film/bias_estimate.h"
#include "film/class_contrasts.h"
#include "film/relative_weights.h"
#include "film/tile_spread.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

constexpr double burstDegrees = 1000;  // as good as normal

/// What pixels and tiles contribute to relMSE.
struct ErrorParts {
    double relMse = 0;
    double unconfirmed = 0;  ///< with weights that rare bright samples did not lessen (film/relative_weights.h)
    double bursts = 0;       ///< variance of relMSE by the number of rare samples that have come
    std::vector<float> pixels;
    std::optional<SquaredBias> bias;
    Tiles tiles = emptyTiles();
};

ErrorParts errorParts(const FilmSums& sums, const ClassContrasts& contrasts) {
    ErrorParts parts;
    const RelativeWeights weights = relativeWeights(sums.layout, contrasts);
    const uint64_t pixels = sums.layout.pixels();
    const uint32_t count = contrasts.count();
    parts.pixels.resize(pixels);
    parts.bias = squaredBias(sums, weights.luminances);
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

double percentOf(double square) { return 100 * std::sqrt(std::max(square, 0.0)); }

/// To an estimate of noise alone, as far as it is credible: what may be nothing but noise would make every small image
/// wait for a certainty about its bias. Squares add up; so do the squares of how far their intervals reach to either
/// side (Zou & Donner 2008).
void addBias(const SquaredBias& bias, ErrorEstimate& estimate) {
    const auto squareOf = [](double percent) { return percent * percent / 10000; };
    const auto square = [](double factor) { return factor * factor / (biasPerBlur * biasPerBlur); };
    const double low = square(smoothBiasPerBlur) * std::max(bias.low, 0.0);
    const double high = square(borderBiasPerBlur) * std::max(bias.high, 0.0);
    const double credible = bias.credible(), noise = squareOf(estimate.percent);
    const double told = credible > 0 ? credible * bias.value : 0;
    const double below = std::hypot(noise - squareOf(estimate.low), credible * (bias.value - low));
    const double above = std::hypot(squareOf(estimate.high) - noise, credible * (high - bias.value));
    estimate.bias = {percentOf(told), percentOf(low), percentOf(high)};
    estimate.percent = percentOf(noise + told);
    estimate.low = percentOf(noise + told - below);
    estimate.high = percentOf(noise + told + above);
}

}  // namespace

std::optional<ErrorEstimate> estimateError(const FilmSums& sums) {
    const ClassContrasts contrasts(sums);
    if (contrasts.classes() < 2) return std::nullopt;
    const ErrorParts parts = errorParts(sums, contrasts);
    ErrorEstimate estimate;
    estimate.iterations = sums.iterations;
    estimate.percent = estimate.low = estimate.high = estimate.noisePercent = 100 * std::sqrt(parts.relMse);
    if (parts.relMse == 0) return estimate;
    const uint32_t count = contrasts.count();
    const Spread spread = withoutBorders(spreadOf, parts.tiles, count);
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
    if (parts.bias) addBias(*parts.bias, estimate);
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
