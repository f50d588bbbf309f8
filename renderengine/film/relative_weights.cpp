#include "film/relative_weights.h"

#include <algorithm>
#include <cmath>

#include "renderengine/error_estimate.h"

namespace antipode {
namespace {

// Found on renders of nine scenes by three techniques (docs/accuracy/calibration.md), and held by tests against truth.
constexpr double shrinkage = 2;             // λ
constexpr double secondOrder = 0.5;         // part of the correction for the reference's variance
constexpr double confirmedPart = 1.0 / 6;   // of what confirmation lets expect
constexpr double confirmingIterations = 8;  // of a class: of so many half of that part
constexpr uint32_t radii[] = {8, 4, 2, 1, 0};
constexpr uint32_t halo = radii[0], core = 64;

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

/// Sums over rectangles of each class and channel, over a part of the image.
class SummedArea {
public:
    void build(const FilmLayout& layout, const ClassContrasts& contrasts, uint32_t left, uint32_t top, uint32_t right,
               uint32_t bottom) {
        left_ = left, top_ = top, stride_ = right - left + 1;
        sums_.assign(size_t(stride_) * (bottom - top + 1), Cell{});
        for (uint32_t y = top; y < bottom; ++y)
            for (uint32_t x = left; x < right; ++x)
                for (uint32_t c = 0; c < 3; ++c) {
                    const Means means = contrasts.means(3 * (size_t(y) * layout.width + x) + c);
                    for (uint32_t k = 0; k < contrasts.classes(); ++k)
                        at(x + 1, y + 1)[c][k] = means[k] + at(x, y + 1)[c][k] + at(x + 1, y)[c][k] - at(x, y)[c][k];
                }
    }

    /// Means of channel c over the part of the window within the image.
    Means means(const FilmLayout& layout, uint32_t x, uint32_t y, uint32_t radius, uint32_t c, uint32_t classes) const {
        const uint32_t x0 = x > radius ? x - radius : 0, x1 = std::min(x + radius + 1, layout.width);
        const uint32_t y0 = y > radius ? y - radius : 0, y1 = std::min(y + radius + 1, layout.height);
        const double pixels = double(x1 - x0) * (y1 - y0);
        Means means{};
        for (uint32_t k = 0; k < classes; ++k)
            means[k] = (at(x1, y1)[c][k] - at(x0, y1)[c][k] - at(x1, y0)[c][k] + at(x0, y0)[c][k]) / pixels;
        return means;
    }

private:
    using Cell = std::array<Means, 3>;
    Cell& at(uint32_t x, uint32_t y) { return sums_[size_t(y - top_) * stride_ + (x - left_)]; }
    const Cell& at(uint32_t x, uint32_t y) const { return sums_[size_t(y - top_) * stride_ + (x - left_)]; }

    uint32_t left_ = 0, top_ = 0, stride_ = 0;
    std::vector<Cell> sums_;
};

/// The classes of a pixel with their noise shrunk, and what variance that leaves to the mean of all.
struct Smooth {
    std::array<Means, 3> classes;
    std::array<double, 3> variance;
};

class Smoother {
public:
    Smoother(const FilmLayout& layout, const ClassContrasts& contrasts) : layout_(layout), contrasts_(contrasts) {
        const uint64_t pixels = layout.pixels();
        for (uint64_t p = 0; p < pixels; ++p)
            for (uint32_t c = 0; c < 3; ++c) {
                const Means means = contrasts.means(3 * p + c);
                for (uint32_t k = 0; k < contrasts.classes(); ++k) image_[c][k] += means[k] / double(pixels);
            }
    }

    Smooth smooth(const SummedArea& area, uint32_t x, uint32_t y) const {
        Smooth smooth{image_, {}};
        for (uint32_t c = 0; c < 3; ++c) smooth.variance[c] = contrasts_.variance(image_[c]);
        std::array<Means, 3> coarse = image_;
        for (const uint32_t radius : radii) {
            std::array<Means, 3> detail;
            std::array<double, 3> noise;
            double size = 0, noises = 0;
            for (uint32_t c = 0; c < 3; ++c) {
                const Means fine = area.means(layout_, x, y, radius, c, contrasts_.classes());
                double mean = 0;
                for (uint32_t k = 0; k < contrasts_.classes(); ++k) {
                    detail[c][k] = fine[k] - coarse[c][k];
                    mean += contrasts_.iterations(k) * detail[c][k] / contrasts_.iterations();
                }
                noise[c] = contrasts_.variance(detail[c]);
                size += mean * mean, noises += noise[c];
                coarse[c] = fine;
            }
            const double kept = size > 0 ? std::max(1 - shrinkage * noises / size, 0.0) : 0;
            for (uint32_t c = 0; c < 3; ++c) {
                for (uint32_t k = 0; k < contrasts_.classes(); ++k) smooth.classes[c][k] += kept * detail[c][k];
                smooth.variance[c] += kept * kept * noise[c];
            }
        }
        return smooth;
    }

private:
    const FilmLayout& layout_;
    const ClassContrasts& contrasts_;
    std::array<Means, 3> image_{};
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

}  // namespace

RelativeWeights relativeWeights(const FilmLayout& layout, const ClassContrasts& contrasts) {
    const size_t values = layout.offset(1);
    const Confirmation confirmation(contrasts, values);
    const Smoother smoother(layout, contrasts);
    RelativeWeights weights{std::vector<float>(values), std::vector<float>(values)};
    SummedArea area;
    for (uint32_t top = 0; top < layout.height; top += core)
        for (uint32_t left = 0; left < layout.width; left += core) {
            const uint32_t right = std::min(left + core, layout.width), bottom = std::min(top + core, layout.height);
            area.build(layout, contrasts, left > halo ? left - halo : 0, top > halo ? top - halo : 0,
                       std::min(right + halo, layout.width), std::min(bottom + halo, layout.height));
            for (uint32_t y = top; y < bottom; ++y)
                for (uint32_t x = left; x < right; ++x) {
                    const Smooth smooth = smoother.smooth(area, x, y);
                    for (uint32_t c = 0; c < 3; ++c) {
                        const size_t i = 3 * (size_t(y) * layout.width + x) + c;
                        const Weight weight = weightOf(contrasts, confirmation, contrasts.means(i), smooth.classes[c],
                                                       smooth.variance[c]);
                        weights.values[i] = float(weight.value);
                        weights.unconfirmed[i] = float(weight.unconfirmed);
                    }
                }
        }
    return weights;
}

}  // namespace antipode
