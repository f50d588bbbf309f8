#include "film/relative_weights.h"

#include <algorithm>
#include <array>

#include "renderengine/error_estimate.h"

namespace antipode {
namespace {

/// 1/(x² + ε) for an x of variance `variance`, less what the variance adds to its mean: half the second derivative, as
/// a quotient, which stays positive.
double inverseDenominator(double x, double variance) {
    const double denominator = x * x + relativeErrorEpsilon;
    const double excess = variance * (3 * x * x - relativeErrorEpsilon) / (denominator * denominator);
    return (excess < 0 ? 1 - excess : 1 / (1 + excess)) / denominator;
}

struct Reference {
    double mean = 0, variance = 0;
};

/// Of all classes but a and b; of both where there are no others.
Reference rest(const ClassContrasts& contrasts, const ClassContrasts::Means& means, uint32_t a, uint32_t b) {
    double count = 0, sum = 0;
    if (contrasts.classes() == 2) {
        for (uint32_t k = 0; k < 2; ++k) sum += contrasts.iterations(k) * means[k];
        return {sum / contrasts.iterations(), contrasts.variance(means)};
    }
    for (uint32_t k = 0; k < contrasts.classes(); ++k)
        if (k != a && k != b) count += contrasts.iterations(k), sum += contrasts.iterations(k) * means[k];
    const double mean = sum / count;
    if (contrasts.classes() == 3) return {mean, 0};
    double squares = 0;
    for (uint32_t k = 0; k < contrasts.classes(); ++k)
        if (k != a && k != b) squares += contrasts.iterations(k) * (means[k] - mean) * (means[k] - mean);
    return {mean, squares / (count * (contrasts.classes() - 3))};
}

/// How far references are drawn towards their mean: 0 leaves them where they are, 1 makes them equal.
double drawing(double noise, double spread) {
    return spread > 0 ? std::clamp(1.5 * noise / spread - 0.1, 0.0, 1.0) : 0;
}

/// Draws the references of a cell towards their mean and leaves each the variance that it then has.
void draw(std::span<Reference> references) {
    const double pixels = double(references.size());
    double mean = 0, noise = 0, spread = 0;
    for (const Reference& each : references) mean += each.mean / pixels, noise += each.variance / pixels;
    for (const Reference& each : references) spread += (each.mean - mean) * (each.mean - mean);
    const double kept = 1 - drawing(noise, pixels > 1 ? spread / (pixels - 1) : 0);
    for (Reference& each : references) {
        each.mean = mean + kept * (each.mean - mean);
        each.variance = kept * kept * each.variance + (1 - kept * kept) * noise / pixels;
    }
}

}  // namespace

void relativeWeights(const ClassContrasts& contrasts, std::span<const ClassContrasts::Means> cell,
                     std::span<double> weights) {
    std::array<Reference, relativeCellPixels> references;
    std::array<double, relativeCellPixels> squares{};
    const size_t pixels = cell.size();
    std::fill_n(weights.begin(), pixels, 0.0);
    for (uint32_t a = 0; a + 1 < contrasts.classes(); ++a)
        for (uint32_t b = a + 1; b < contrasts.classes(); ++b) {
            for (size_t p = 0; p < pixels; ++p) references[p] = rest(contrasts, cell[p], a, b);
            draw(std::span(references).first(pixels));
            for (size_t p = 0; p < pixels; ++p) {
                const double difference = cell[p][a] - cell[p][b];
                const double square = contrasts.iterations(a) * contrasts.iterations(b) * difference * difference;
                squares[p] += square;
                weights[p] += square * inverseDenominator(references[p].mean, references[p].variance);
            }
        }
    for (size_t p = 0; p < pixels; ++p) weights[p] = squares[p] > 0 ? weights[p] / squares[p] : 0;
}

}  // namespace antipode
