// The estimate of what merging blurs, on films of known bias and noise.
//
// Calibration: null hypothesis: the 95 % interval holds the bias with probability 0.95. Rejected where the number of
// misses among `films` independent ones has less than 10^-4 probability (binomial, exact); seeds 1 to `films`.
#include "film/bias_estimate.h"

#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "renderengine/error.h"
#include "renderengine/error_classes.h"
#include "renderengine/error_estimate.h"
#include "tests/film/binomial.h"

using namespace antipode;

namespace {

constexpr uint32_t side = 48;
constexpr int32_t scale = 24;
constexpr double brightness = 0.5;

using Random = std::mt19937_64;
/// One iteration's noise of the difference that the blur layer sums, row-major.
using Noise = std::function<void(Random&, std::vector<double>&)>;

/// The bias that a film is made with: broad waves, and a border where it jumps.
double biasAt(double size, uint32_t x, uint32_t y) {
    return size * brightness * (std::sin(0.4 * x) * std::cos(0.3 * y) + (x == 30 ? 2.0 : 0.0));
}

/// Iterations of an image without noise, and of a blur layer of half the bias.
FilmSums filmOf(uint64_t seed, uint64_t iterations, double size, const Noise& noise) {
    Random random(seed);
    FilmSums sums{
        withErrorClasses({side, side, {{LayerKind::Image, "", "RGB", scale}, {LayerKind::Blur, "bias", "Y", scale}}}),
        iterations,
        {},
        {}};
    sums.values.resize(sums.layout.values());
    sums.residueIterations.assign(errorClasses, 0);
    const auto add = [](int64_t& sum, double value) { sum += std::llround(std::ldexp(value, scale)); };
    std::vector<double> deviation(side * side);
    for (uint64_t i = 0; i < iterations; ++i) {
        const uint32_t own = errorClass(i);
        ++sums.residueIterations[own];
        for (int64_t& sum : sums.layer(own)) add(sum, brightness);
        std::ranges::fill(deviation, 0);
        noise(random, deviation);
        const std::span<int64_t> blur = sums.layer(sums.layout.find(LayerKind::Blur) + own);
        for (uint32_t p = 0; p < side * side; ++p)
            add(blur[p], biasAt(size, p % side, p / side) / biasPerBlur + deviation[p]);
    }
    return sums;
}

/// √relMSE of the bias.
double trueBias(double size) {
    double square = 0;
    for (uint32_t p = 0; p < side * side; ++p) square += std::pow(biasAt(size, p % side, p / side), 2);
    return std::sqrt(square / (side * side) / (brightness * brightness + relativeErrorEpsilon));
}

std::vector<float> weights() {
    return std::vector<float>(side * side, float(1 / (brightness * brightness + relativeErrorEpsilon)));
}

void independent(Random& random, std::vector<double>& noise) {
    std::normal_distribution<double> normal;
    for (double& n : noise) n = 0.2 * normal(random);
}

/// As neighbours share light vertices: means over 3×3, with a seam where they wrap.
void correlated(Random& random, std::vector<double>& noise) {
    std::vector<double> white(noise.size());
    independent(random, white);
    for (size_t p = 0; p < noise.size(); ++p)
        for (const size_t by : {0u, 1u, 2u})
            for (const size_t down : {0u, side, 2 * side}) noise[p] += white[(p + by + down) % noise.size()] / 3;
}

/// Half of the noise by one sample in 500.
void rare(Random& random, std::vector<double>& noise) {
    independent(random, noise);
    for (double& n : noise)
        if (random() % 500 == 0) n += random() % 2 == 0 ? 4.5 : -4.5;
}

struct Case {
    const char* name;
    double size;  ///< of the bias
    uint64_t iterations;
    Noise noise;
};

class BiasEstimateTest : public testing::TestWithParam<Case> {};

}  // namespace

TEST_P(BiasEstimateTest, TheIntervalHoldsTheBiasAsOftenAsItSays) {
    constexpr int films = 100;
    const double truth = trueBias(GetParam().size) * trueBias(GetParam().size);
    int misses = 0;
    double mean = 0, squares = 0, told = 0;
    for (uint64_t seed = 1; seed <= films; ++seed) {
        const SquaredBias bias =
            squaredBias(filmOf(seed, GetParam().iterations, GetParam().size, GetParam().noise), weights()).value();
        misses += bias.low > truth || bias.high < truth;
        mean += bias.value / films;
        squares += (bias.value - truth) * (bias.value - truth) / films;
        told += bias.standardError * bias.standardError / films;
    }
    SCOPED_TRACE(testing::Message() << misses << " misses; mean " << mean << " for " << truth << ", spread "
                                    << std::sqrt(squares) << ", told " << std::sqrt(told));
    RecordProperty("misses", misses);
    EXPECT_GT(1 - test::binomialBelow(misses - 1, films, 0.05), 1e-4);
    EXPECT_NEAR(mean, truth, 4 * std::sqrt(squares / films));
    EXPECT_LT(told, 2.25 * squares) << "the interval is wider than it need be";
}

INSTANTIATE_TEST_SUITE_P(Noise, BiasEstimateTest,
                         testing::Values(Case{"NoBias", 0, 16, independent}, Case{"Little", 0.03, 16, independent},
                                         Case{"Much", 0.3, 21, independent}, Case{"Correlated", 0.05, 16, correlated},
                                         Case{"CorrelatedMuch", 0.3, 32, correlated},
                                         Case{"CorrelatedNoBias", 0, 32, correlated}, Case{"Rare", 0.05, 32, rare}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(BiasEstimate, ASampleThatOneClassAloneHasMetTellsNothing) {
    FilmSums sums = filmOf(1, 16, 0, [](Random&, std::vector<double>&) {});
    const size_t blur = sums.layout.find(LayerKind::Blur);
    sums.layer(blur + 2)[700] = int64_t(100) << scale;
    const SquaredBias bias = squaredBias(sums, weights()).value();
    EXPECT_NEAR(bias.value, 0, 1e-12) << "100/16 in one pixel alone would be 41 %";
    const ErrorEstimate estimate = estimateError(sums).value();
    EXPECT_EQ(estimate.percent, 0) << "the image has no noise";
}

TEST(BiasEstimate, NeedsABlurLayerInTwoClasses) {
    const FilmSums sums = filmOf(1, 16, 0.1, independent);
    EXPECT_FALSE(squaredBias(filmOf(1, 1, 0.1, independent), weights()));
    EXPECT_FALSE(squaredBias(outOfErrorClasses(sums), weights()));
    EXPECT_FALSE(squaredBias(sums.imageAlone(), weights()));
    EXPECT_EQ(mergeBias(sums.imageAlone()), std::vector<float>(side * side, 0.0f)) << "what does not merge has none";
    EXPECT_THROW(mergeBias(filmOf(1, 1, 0.1, independent)), Error);
}

TEST(BiasEstimate, TheErrorIsNoiseAndBias) {
    FilmSums sums = filmOf(3, 64, 0.2, independent);
    Random random(5);
    std::normal_distribution<double> normal;
    for (uint32_t k = 0; k < errorClasses; ++k)
        for (int64_t& sum : sums.layer(k)) sum += std::llround(std::ldexp(0.8 * normal(random), scale));
    const ErrorEstimate estimate = estimateError(sums).value();
    ASSERT_TRUE(estimate.bias && estimate.bias->told());
    EXPECT_NEAR(estimate.bias->percent, 100 * trueBias(0.2), 1);
    EXPECT_NEAR(estimate.percent, std::hypot(estimate.noisePercent, estimate.bias->percent), 1e-9);
    EXPECT_LT(estimate.low, std::hypot(estimate.noisePercent, estimate.bias->percent));
    EXPECT_GT(estimate.low, estimate.noisePercent) << "it cannot be noise alone";
    sums.layout.layers.resize(errorClasses);
    sums.values.resize(sums.layout.values());
    const ErrorEstimate noise = estimateError(sums).value();
    EXPECT_EQ(noise.percent, estimate.noisePercent);
    EXPECT_FALSE(noise.bias);
}

TEST(BiasEstimate, TheLayerIsSmoothedAndSigned) {
    // Where the noise of a pixel is as large as what it tells; smoothed, the waves are there.
    const FilmSums sums = filmOf(2, 16, 0.3, independent);
    const std::vector<float> bias = mergeBias(sums);
    double product = 0, own = 0, truth = 0, off = 0;
    for (uint32_t p = 0; p < side * side; ++p) {
        const double exact = biasAt(0.3, p % side, p / side);
        product += exact * bias[p], own += bias[p] * bias[p], truth += exact * exact;
        off += (bias[p] - exact) * (bias[p] - exact);
    }
    EXPECT_GT(product / std::sqrt(own * truth), 0.8);
    EXPECT_LT(off, 0.5 * truth);
}
