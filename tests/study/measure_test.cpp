#include "client/study/measure.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "renderengine/error.h"

using namespace antipode;
using namespace antipode::study;

namespace {

Image grey(uint32_t width, uint32_t height, float value) {
    return {width, height, std::vector<Vec3f>(size_t(width) * height, Vec3f(value))};
}

}  // namespace

TEST(MeasureTiles, IsRelMseAndTakesOffTheReferencesNoise) {
    const Image reference = grey(19, 11, 1), image = grey(19, 11, 1.5f);
    const TileErrors plain = measureTiles(image, {reference, {}});
    EXPECT_NEAR(plain.total(), 0.25 / 1.01, 1e-12);
    EXPECT_NEAR(plain.total(), compareImages(image, reference).relMse, 1e-12);
    EXPECT_EQ(plain.relMse.size(), 64u);
    // Standard error .3 everywhere: .09/1.01 of it is the reference's.
    const TileErrors freed = measureTiles(image, {reference, std::vector<float>(3 * 19 * 11, 0.3f)});
    EXPECT_NEAR(freed.referenceRelMse, 0.09 / 1.01, 1e-7);
    EXPECT_NEAR(freed.total(), 0.16 / 1.01, 1e-7);
}

TEST(MeasureTiles, WeighsTilesByTheirPixels) {
    // 9 columns in 8 tiles: one has two of them.
    const Image reference = grey(9, 1, 0);
    Image image = reference;
    for (uint32_t x = 0; x < 9; ++x) image.pixels[x] = Vec3f(0.1f * float(x));
    const TileErrors errors = measureTiles(image, {reference, {}});
    EXPECT_EQ(errors.relMse.size(), 8u);
    EXPECT_NEAR(errors.total(), compareImages(image, reference).relMse, 1e-9);
}

TEST(MeasureTiles, CountsWhatIsNotFinite) {
    Image image = grey(8, 8, 2);
    image.pixels[5].x = std::numeric_limits<float>::infinity();
    const TileErrors errors = measureTiles(image, {grey(8, 8, 1), {}});
    EXPECT_EQ(errors.nonFinite, 1u);
    EXPECT_NEAR(errors.total(), 1 / 1.01, 1e-12);
}

TEST(MeasureTiles, RefusesAnotherSize) { EXPECT_THROW(measureTiles(grey(2, 1, 0), {grey(1, 2, 0), {}}), Error); }

// H0: the interval holds √relMSE of the distribution that tiles come from in 95 % of cases. 2000 images of 64 tiles
// with exponential errors; seed 7. Significance 1e-4: |share − .95| within 3.9·√(.95·.05/2000) = .019; the jackknife of
// a skewed mean is known to hold it a little less often, by no more than .01 at 64 tiles.
TEST(PercentOf, IntervalHoldsAsOftenAsItSays) {
    std::mt19937_64 random(7);
    std::exponential_distribution<double> draw(1);
    int held = 0;
    for (int i = 0; i < 2000; ++i) {
        TileErrors errors;
        for (int t = 0; t < 64; ++t) errors.relMse.push_back(draw(random)), errors.share.push_back(1.0 / 64);
        const Interval percent = percentOf(errors);
        held += percent.low <= 100 && percent.high >= 100;
    }
    EXPECT_GT(held / 2000.0, 0.95 - 0.019 - 0.01);
    EXPECT_LT(held / 2000.0, 0.95 + 0.019);
}

TEST(ErrorRatio, CancelsWhatImagesHaveInCommon) {
    TileErrors base, twice;
    for (int t = 0; t < 16; ++t) {
        base.relMse.push_back(std::pow(2, t)), twice.relMse.push_back(4 * std::pow(2, t));
        base.share.push_back(1.0 / 16), twice.share.push_back(1.0 / 16);
    }
    const Interval ratio = errorRatio(twice, base);
    EXPECT_NEAR(ratio.value, 2, 1e-12);
    EXPECT_NEAR(ratio.low, 2, 1e-9);
    EXPECT_NEAR(ratio.high, 2, 1e-9);
    base.relMse.assign(16, -1);
    EXPECT_TRUE(std::isnan(errorRatio(twice, base).value));
}

// Means 2 and 1; variances of the mean 1/(2−1)/2² … : durations 1, 3 have mean 2 and squared deviation 1, so the
// logarithm's variance is 1/1/4; the base has none. Student's quantile of one degree is 12.7062.
TEST(DurationRatio, IsWorkedOutByHand) {
    Durations slow, fast;
    slow.add(1), slow.add(3), fast.add(1), fast.add(1);
    const Interval ratio = durationRatio(slow, fast);
    EXPECT_NEAR(ratio.value, 2, 1e-12);
    EXPECT_NEAR(std::log(ratio.high / 2), 12.706205 * 0.5, 1e-6);
    EXPECT_TRUE(std::isnan(durationRatio(slow, {}).value));
}
