#include "film/relative_weights.h"

#include <algorithm>
#include <cmath>

#include "film/class_smoother.h"
#include "renderengine/error_estimate.h"

namespace antipode {
namespace {

// Found on renders of nine scenes by three techniques (docs/accuracy/calibration.md), and held by tests against truth;
// so is the smoother's λ.
constexpr double secondOrder = 0.5;         // part of the correction for the reference's variance
constexpr double confirmedPart = 1.0 / 6;   // of what confirmation lets expect
constexpr double confirmingIterations = 8;  // of a class: of so many half of that part

using Means = ClassContrasts::Means;

/// 1/(x² + ε) for an x of variance `variance`, less what that adds to its mean: half the second derivative, as a
/// quotient, where it is positive.
double inverseDenominator(double x, double variance) {
    const double denominator = x * x + relativeErrorEpsilon;
    const double excess = variance * (3 * x * x - relativeErrorEpsilon) / (denominator * denominator);
    return 1 / ((1 + std::max(excess, 0.0)) * denominator);
}

/// What share of a brightness that one class has met the others have met at the same value, by half octaves.
class Confirmation {
public:
    explicit Confirmation(const ClassContrasts& contrasts, size_t values) {
        const uint32_t K = contrasts.classes();
        for (size_t i = 0; i < values; ++i) {
            const Means means = contrasts.means(i);
            for (uint32_t a = 0; a < K; ++a) {
                if (!(means[a] > 0)) continue;
                Bin& bin = bins_[indexOf(means[a])];
                for (uint32_t b = 0; b < K; ++b)
                    if (b != a) bin.met += std::min(means[b], means[a]) * means[a];
                bin.all += (K - 1) * means[a] * means[a];
            }
        }
        const double iterations = contrasts.iterations() / K;
        part_ = confirmedPart * iterations / (iterations + confirmingIterations);
    }

    /// The least light to expect at a value of which one class has met so much.
    double leastExpected(double met) const {
        if (!(met > 0)) return 0;
        const Bin& bin = bins_[indexOf(met)];
        return bin.all > 0 ? part_ * std::max(bin.met / bin.all, 0.0) * met : 0;
    }

private:
    struct Bin {
        double met = 0, all = 0;
    };
    static constexpr int count = 256;

    static size_t indexOf(double value) {
        return size_t(std::clamp(std::floor(2 * std::log2(value)) + 0.5 * count, 0.0, count - 1.0));
    }

    std::array<Bin, count> bins_;
    double part_ = 0;
};

struct Weight {
    double value = 0, unconfirmed = 0;
};

/// Of a value with these means of its classes, smoothed ones and the variance of those ones' mean.
Weight weightOf(const ClassContrasts& contrasts, const Confirmation& confirmation, const Means& means,
                const Means& smooth, double variance) {
    const uint32_t K = contrasts.classes();
    const double N = contrasts.iterations();
    double all = 0, squares = 0;
    for (uint32_t k = 0; k < K; ++k) all += contrasts.iterations(k) * smooth[k];
    Weight weight;
    for (uint32_t a = 0; a + 1 < K; ++a)
        for (uint32_t b = a + 1; b < K; ++b) {
            const double na = contrasts.iterations(a), nb = contrasts.iterations(b);
            const double rest = K == 2 ? N : N - na - nb;
            const double sum = K == 2 ? all : all - na * smooth[a] - nb * smooth[b];
            const double reference = std::max(sum / rest, 0.0), left = secondOrder * variance * N / rest;
            const double least = confirmation.leastExpected(std::max(means[a], means[b]));
            const double square = na * nb * (means[a] - means[b]) * (means[a] - means[b]);
            const double unconfirmed = inverseDenominator(reference, left);
            squares += square;
            weight.unconfirmed += square * unconfirmed;
            weight.value += square * (least > reference ? inverseDenominator(least, left) : unconfirmed);
        }
    if (!(squares > 0)) return {};
    return {weight.value / squares, weight.unconfirmed / squares};
}

/// Of a pixel's luminance, whose error has the colour of the pixel.
double luminanceWeight(const ClassContrasts& contrasts, const Smooth& smooth) {
    Vec3d colour, inverse;
    for (uint32_t c = 0; c < 3; ++c) {
        double mean = 0;
        for (uint32_t k = 0; k < contrasts.classes(); ++k)
            mean += contrasts.iterations(k) * smooth.classes[c][k] / contrasts.iterations();
        colour[int(c)] = std::max(mean, 0.0);
        inverse[int(c)] = inverseDenominator(colour[int(c)], secondOrder * smooth.variance[c]);
    }
    const double bright = luminance(colour);
    const Vec3d relative = bright > 0 ? colour / bright : Vec3d(1.0);
    return dot(relative * relative, inverse) / 3;
}

}  // namespace

RelativeWeights relativeWeights(const FilmLayout& layout, const ClassContrasts& contrasts) {
    const size_t values = layout.offset(1);
    const Confirmation confirmation(contrasts, values);
    RelativeWeights weights{std::vector<float>(values), std::vector<float>(values),
                            std::vector<float>(layout.pixels())};
    ClassSmoother(layout, contrasts, 3).forEachPixel([&](size_t pixel, const Smooth& smooth) {
        for (uint32_t c = 0; c < 3; ++c) {
            const size_t i = 3 * pixel + c;
            const Weight weight =
                weightOf(contrasts, confirmation, contrasts.means(i), smooth.classes[c], smooth.variance[c]);
            weights.values[i] = float(weight.value);
            weights.unconfirmed[i] = float(weight.unconfirmed);
        }
        weights.luminances[pixel] = float(luminanceWeight(contrasts, smooth));
    });
    return weights;
}

}  // namespace antipode
