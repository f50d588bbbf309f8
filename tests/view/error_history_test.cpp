#include "client/view/error_history.h"

#include <gtest/gtest.h>

using namespace antipode;
using view::ErrorHistory;

namespace {

ErrorEstimate errorOf(double percent) {
    ErrorEstimate estimate;
    estimate.percent = percent;
    return estimate;
}

}  // namespace

TEST(ErrorHistory, KeepsTheFirstTheLatestAndFewInBetween) {
    ErrorHistory history;
    for (int i = 1; i <= 100000; ++i) history.add(0.1 * i, errorOf(100.0 / i));
    const auto& points = history.points();
    EXPECT_EQ(points.front().seconds, 0.1);
    EXPECT_EQ(points.back().percent, 100.0 / 100000);
    // ln(10⁵)/ln(1.05) = 236 twentieths; while time grows by more at once each estimate is one.
    EXPECT_LT(points.size(), 250u);
    EXPECT_GT(points.size(), 150u);
    for (size_t i = 1; i + 1 < points.size(); ++i)
        EXPECT_GE(points[i].seconds, 1.05 * points[i - 1].seconds * (1 - 1e-12)) << i;
}

TEST(ErrorHistory, LeavesOutWhatNoLogarithmicPlotCanShow) {
    ErrorHistory history;
    history.add(0, errorOf(5));
    history.add(1, errorOf(0));
    EXPECT_TRUE(history.points().empty());
    history.add(1, errorOf(5));
    EXPECT_EQ(history.points().size(), 1u);
}
