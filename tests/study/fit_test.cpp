#include "client/study/fit.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace antipode::study;

TEST(PowerLaw, IsFoundWherePointsLieOnIt) {
    const auto law = fitPowerLaw({{1, 8}, {4, 4}, {16, 2}, {64, 1}});
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->slope, -0.5, 1e-12);
    EXPECT_NEAR(law->scale, 8, 1e-12);
    EXPECT_NEAR(law->slopeLow, -0.5, 1e-6);
    EXPECT_NEAR(law->slopeHigh, -0.5, 1e-6);
}

// x = 0, 1, 2 and y = 0, 1, 0 (natural logarithms): slope 0, residual 2/3, one degree of freedom,
// so the standard error is sqrt(2/3/1/2) = .57735 and the half-width 12.7062 times that.
TEST(PowerLaw, IntervalIsWorkedOutByHand) {
    const double e = std::exp(1.0);
    const auto law = fitPowerLaw({{1, 1}, {e, e}, {e * e, 1}});
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->slope, 0, 1e-12);
    EXPECT_NEAR(law->slopeHigh, 12.706205 * std::sqrt(1.0 / 3), 1e-6);
    EXPECT_NEAR(law->slopeLow, -law->slopeHigh, 1e-9);
}

TEST(PowerLaw, NeedsThreePositivePointsAtTwoTimes) {
    EXPECT_FALSE(fitPowerLaw({{1, 2}, {2, 1}}));
    EXPECT_FALSE(fitPowerLaw({{1, 2}, {2, 1}, {3, 0}}));
    EXPECT_FALSE(fitPowerLaw({{0, 2}, {2, 1}, {3, 1}}));
    EXPECT_FALSE(fitPowerLaw({{2, 2}, {2, 1}, {2, 1}}));
}

TEST(TimeTo, IsReadBetweenMeasuredPoints) {
    const std::vector<Point> points{{1, 8}, {4, 4}, {16, 2}};
    const auto time = timeTo(4 / std::sqrt(2), points, fitPowerLaw(points));
    ASSERT_TRUE(time);
    EXPECT_NEAR(time->seconds, 8, 1e-9);
    EXPECT_FALSE(time->extrapolated);
    EXPECT_NEAR(timeTo(20, points, std::nullopt)->seconds, 1, 0) << "reached from the first point on";
}

TEST(TimeTo, CountsFromWhereTheErrorStaysBelow) {
    // Below 3 at 2 s, above again at 4 s, for good between 4 and 8 s.
    EXPECT_GT(timeTo(3, {{1, 8}, {2, 2.9}, {4, 4}, {8, 2}}, std::nullopt)->seconds, 4);
}

TEST(TimeTo, GoesBeyondTheLastPointOnlyWhereTheErrorSurelyFalls) {
    const std::vector<Point> falling{{1, 8}, {4, 4}, {16, 2}};
    const auto law = fitPowerLaw(falling);
    const auto time = timeTo(1, falling, law);
    ASSERT_TRUE(time);
    EXPECT_NEAR(time->seconds, 64, 1e-9);
    EXPECT_TRUE(time->extrapolated);
    EXPECT_FALSE(timeTo(0.1, falling, law)) << "400 times as far";
    const std::vector<Point> flat{{1, 8}, {4, 7.9}, {16, 8.1}, {64, 7.9}};
    EXPECT_FALSE(timeTo(1, flat, fitPowerLaw(flat)));
    EXPECT_FALSE(timeTo(1, falling, std::nullopt));
    EXPECT_FALSE(timeTo(1, {}, law));
}

// Tables of Student's distribution.
TEST(StudentQuantile, AgreesWithTables) {
    EXPECT_NEAR(studentQuantile95(1), 12.7062, 1e-4);
    EXPECT_NEAR(studentQuantile95(2), 4.30265, 1e-5);
    EXPECT_NEAR(studentQuantile95(3), 3.18245, 0.01 * 3.18245);
    EXPECT_NEAR(studentQuantile95(5), 2.57058, 0.003 * 2.57058);
    EXPECT_NEAR(studentQuantile95(10), 2.22814, 1e-3);
    EXPECT_NEAR(studentQuantile95(63), 1.99834, 1e-4);
}
