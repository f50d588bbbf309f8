#include "film/bias_estimate.h"

#include <algorithm>
#include <cmath>

#include "film/class_smoother.h"
#include "film/relative_weights.h"
#include "film/tile_spread.h"
#include "renderengine/error.h"
#include "renderengine/error_estimate.h"

namespace antipode {
namespace {

using Means = ClassContrasts::Means;

/// What pixels add up to, by tiles.
class Parts {
public:
    explicit Parts(const ClassContrasts& contrasts) : contrasts_(contrasts) {}

    /// `weight` takes the square of D's error to the sum.
    void add(uint32_t tile, double weight, const Means& means) {
        const uint32_t K = contrasts_.classes(), count = contrasts_.count();
        double mean = 0, variance = 0;
        for (uint32_t k = 0; k < K; ++k) mean += contrasts_.iterations(k) * means[k] / contrasts_.iterations();
        for (uint32_t j = 0; j < count; ++j) {
            const double contrast = contrasts_.contrast(j, means);
            variance += contrast * contrast / count;
            squares_[tile][j] += weight * contrast * contrast;
            if (K < distinct) products_[tile][j] += 2 * weight * mean * contrast;
        }
        value_ += weight * (mean * mean - variance);
        if (K < distinct) return;
        for (uint32_t a = 0; a < K; ++a)
            for (uint32_t c = 0; c < K; ++c)
                for (uint32_t d = c + 1; d < K; ++d)
                    crossed_[tile][a][c][d] += weight * means[a] * (means[c] - means[d]);
    }

    double value() const { return value_; }

    /// Of the value. A bias b and the noise n of the mean, of variance s², make (b + n)² − s²: that varies by 4b²s² +
    /// 2s⁴, and by 2s⁴/(K − 1) for what is taken off as s².
    Spread spread() const {
        const uint32_t count = contrasts_.count();
        const Spread noise = withoutBorders(spreadOf, squares_, count);
        if (contrasts_.classes() >= distinct)
            return {noise.variance * (1 + 1.0 / count) + std::max(variedBias(), 0.0), noise.degreesOfFreedom};
        // 2(b + n)·contrast varies by 4b²s² + 4s⁴, and by far more where a single sample makes both.
        return withoutBorders(spreadAboutZero, products_, count);
    }

private:
    static constexpr uint32_t distinct = 4;
    using Crossed = std::array<std::array<Means, ClassContrasts::most>, ClassContrasts::most>;

    /// 4b²s², where classes a and b tell of the bias and what c and d differ by of the noise: without a fourth power of
    /// anything, so that a single bright sample does not make it.
    double variedBias() const {
        const uint32_t K = contrasts_.classes();
        double sum = 0;
        uint32_t terms = 0;
        for (uint32_t c = 0; c < K; ++c)
            for (uint32_t d = c + 1; d < K; ++d)
                for (uint32_t a = 0; a < K; ++a)
                    for (uint32_t b = a + 1; b < K; ++b) {
                        if (a == c || a == d || b == c || b == d) continue;
                        const double ofMean = 1 / contrasts_.iterations();
                        const double ofDifference = 1 / contrasts_.iterations(c) + 1 / contrasts_.iterations(d);
                        for (const Crossed& tile : crossed_)
                            sum += 4 * ofMean / ofDifference * tile[a][c][d] * tile[b][c][d];
                        ++terms;
                    }
        return sum / terms;
    }

    const ClassContrasts& contrasts_;
    double value_ = 0;
    Tiles squares_ = emptyTiles(), products_ = emptyTiles();
    std::vector<Crossed> crossed_ = std::vector<Crossed>(squares_.size());
};

}  // namespace

std::optional<SquaredBias> squaredBias(const FilmSums& sums, std::span<const float> weights) {
    const ClassContrasts contrasts(sums, LayerKind::Blur);
    if (contrasts.classes() < 2) return std::nullopt;
    Parts parts(contrasts);
    const uint64_t pixels = sums.layout.pixels();
    for (uint64_t p = 0; p < pixels; ++p)
        parts.add(tileOf(sums.layout, p), biasPerBlur * biasPerBlur * double(weights[p]) / double(pixels),
                  contrasts.means(p));
    const Spread spread = parts.spread();
    const double standardError = std::sqrt(spread.variance);
    const double reach = studentQuantile(spread.degreesOfFreedom) * standardError;
    return SquaredBias{parts.value(), standardError, parts.value() - reach, parts.value() + reach};
}

double SquaredBias::credible() const {
    return value > standardError ? 1 - standardError * standardError / (value * value) : 0;
}

std::vector<float> mergeBias(const FilmSums& sums) {
    std::vector<float> bias(sums.layout.pixels());
    const ClassContrasts contrasts(sums, LayerKind::Blur);
    if (sums.layout.count(LayerKind::Blur) == 0) return bias;
    if (contrasts.classes() < 2)
        throw Error(ErrorCode::Usage, "An image in fewer than two classes of iterations tells no bias.");
    const std::vector<float> weights = relativeWeights(sums.layout, ClassContrasts(sums)).luminances;
    ClassSmoother(sums.layout, contrasts, 1).forEachPixelAlike(weights, [&](size_t pixel, const Smooth& smooth) {
        double mean = 0;
        for (uint32_t k = 0; k < contrasts.classes(); ++k)
            mean += contrasts.iterations(k) * smooth.classes[0][k] / contrasts.iterations();
        bias[pixel] = float(biasPerBlur * mean);
    });
    return bias;
}

}  // namespace antipode
