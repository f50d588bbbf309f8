#include "support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/random.h"

namespace antipode {
namespace {

Moments momentsOf(const std::vector<double>& samples) {
    Moments m;
    for (double s : samples) m.add(s);
    return m;
}

// --- p-values: quantiles of the usual tables ---

TEST(Statistics, NormalP) {
    EXPECT_NEAR(normalTwoSidedP(1.959963984540054), 0.05, 1e-12);
    EXPECT_NEAR(normalTwoSidedP(-2.5758293035489), 0.01, 1e-12);
}

TEST(Statistics, StudentP) {
    EXPECT_NEAR(studentTwoSidedP(1, 1), 0.5, 1e-12);                      // Cauchy
    EXPECT_NEAR(studentTwoSidedP(3, 2), 1 - 3 / std::sqrt(11.0), 1e-12);  // closed form for 2
    EXPECT_NEAR(studentTwoSidedP(2.2281388519649385, 10), 0.05, 1e-10);
    EXPECT_NEAR(studentTwoSidedP(2.6258905214380187, 100), 0.01, 1e-10);
    EXPECT_NEAR(studentTwoSidedP(1.959963984540054, 1e8), 0.05, 1e-7);
    EXPECT_EQ(studentTwoSidedP(std::numeric_limits<double>::infinity(), 5), 0);
}

TEST(Statistics, ChiSquareP) {
    EXPECT_NEAR(chiSquareP(3, 2), std::exp(-1.5), 1e-14);  // exponential for 2
    EXPECT_NEAR(chiSquareP(8, 4), std::exp(-4.0) * 5, 1e-14);
    EXPECT_NEAR(chiSquareP(18.307038053275146, 10), 0.05, 1e-12);
    EXPECT_NEAR(chiSquareP(124.34211340400407, 100), 0.05, 1e-12);
    EXPECT_NEAR(chiSquareP(1e6, 1e6), 0.5, 1e-3);
    EXPECT_EQ(chiSquareP(0, 3), 1);
}

TEST(Statistics, IncompleteBetaIsSymmetricAndExact) {
    for (const double x : {0.0, 0.01, 0.3, 0.7, 0.99, 1.0}) {
        EXPECT_NEAR(regularisedBeta(2, 3, x), x * x * (6 - 8 * x + 3 * x * x), 1e-14);
        EXPECT_NEAR(regularisedBeta(2.5, 0.5, x), 1 - regularisedBeta(0.5, 2.5, 1 - x), 1e-14);
    }
}

// --- Moments and tests ---

TEST(Statistics, MomentsSurviveALargeOffset) {
    const Moments m = momentsOf({1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16});
    EXPECT_DOUBLE_EQ(m.mean(), 1e9 + 10);
    EXPECT_DOUBLE_EQ(m.variance(), 30);
    EXPECT_DOUBLE_EQ(m.meanVariance(), 7.5);
}

TEST(Statistics, TTestAgainstWorkedExample) {
    const TestResult result = tTest(momentsOf({1, 2, 3, 4, 5}), 2);
    EXPECT_NEAR(result.statistic, std::sqrt(2.0), 1e-12);
    EXPECT_EQ(result.degreesOfFreedom, 4);
    EXPECT_NEAR(result.pValue, 0.2301996, 1e-7);
}

TEST(Statistics, WelchTestAgainstWorkedExample) {
    const TestResult result = welchTest(momentsOf({1, 2, 3, 4, 5}), momentsOf({2, 4, 6, 8, 10, 12}));
    EXPECT_NEAR(result.statistic, -4 / std::sqrt(0.5 + 14.0 / 6), 1e-12);
    const double variance = 0.5 + 14.0 / 6;
    EXPECT_NEAR(result.degreesOfFreedom, variance * variance / (0.25 / 4 + 196.0 / 36 / 5), 1e-12);
    EXPECT_LT(result.pValue, 0.06);
    EXPECT_GT(result.pValue, 0.03);
}

TEST(Statistics, TestsWithoutVariance) {
    EXPECT_EQ(tTest(momentsOf({2, 2, 2}), 2).pValue, 1);
    EXPECT_EQ(tTest(momentsOf({2, 2, 2}), 2.001).pValue, 0);
    EXPECT_THROW(tTest(momentsOf({2}), 2), std::invalid_argument);
}

TEST(Statistics, NotANumberNeverPasses) { EXPECT_EQ(tTest(momentsOf({1, 2, std::nan("")}), 2).pValue, 0); }

/// Null hypothesis true: p is uniform, checked by χ² over ten cells (α = .001, seed 11). A false mean is then rejected.
TEST(Statistics, TTestHasItsStatedSignificanceAndPower) {
    Random random(11);
    std::vector<double> cells(10), expected(10, 200.0);
    int rejected = 0;
    for (int i = 0; i < 2000; ++i) {
        Moments m;
        for (int j = 0; j < 50; ++j) m.add(random.uniform() + random.uniform());
        ++cells[std::min(9, int(10 * tTest(m, 1).pValue))];
        rejected += tTest(m, 1.2).pValue < 0.01;
    }
    EXPECT_GT(chiSquareTest(cells, expected).pValue, 0.001);
    EXPECT_GT(rejected, 1500);
}

TEST(Statistics, ChiSquareTestPoolsSmallCells) {
    const std::vector<double> observed{12, 8, 1, 2, 3, 4}, expected{10, 10, 2, 2, 2, 4};
    const TestResult result = chiSquareTest(observed, expected);  // pools: {2,2,2} and {4,10} and {10}
    EXPECT_EQ(result.degreesOfFreedom, 2);
    EXPECT_GT(result.pValue, 0.5);
    EXPECT_EQ(chiSquareTest(std::vector<double>{5, 5, 1}, std::vector<double>{5, 6, 0}).pValue, 0);
    EXPECT_THROW(chiSquareTest(std::vector<double>{5}, std::vector<double>{5}), std::invalid_argument);
}

TEST(Statistics, ChiSquareTestRejectsAWrongDistribution) {
    Random random(12);
    std::vector<double> observed(20), expected(20, 500.0);
    for (int i = 0; i < 10000; ++i) ++observed[size_t(20 * std::pow(random.uniform(), 1.1))];
    EXPECT_LT(chiSquareTest(observed, expected).pValue, 1e-6);
}

TEST(Statistics, Corrections) {
    EXPECT_DOUBLE_EQ(bonferroni(0.01, 100), 1e-4);
    EXPECT_NEAR(sidak(0.05, 3), 1 - std::cbrt(0.95), 1e-15);
}

TEST(Statistics, LogLogSlope) {
    const std::vector<double> x{16, 64, 256, 1024}, y{3 / 4.0, 3 / 8.0, 3 / 16.0, 3 / 32.0};
    const LogLogFit fit = fitLogLog(x, y);
    EXPECT_NEAR(fit.slope, -0.5, 1e-14);
    EXPECT_NEAR(std::exp(fit.intercept), 3, 1e-13);
    EXPECT_NEAR(fit.slopeError, 0, 1e-14);
    EXPECT_THROW(fitLogLog(x, std::vector<double>{1, 2, 3, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace antipode
