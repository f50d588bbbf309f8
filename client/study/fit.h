// What error costs in time: lines through measured points on logarithmic axes. Pure.
#pragma once

#include <optional>
#include <vector>

namespace antipode::study {

struct Point {
    double seconds = 0, percent = 0;
};

/// percent = scale·seconds^slope, by least squares on logarithms.
struct PowerLaw {
    double scale = 0, slope = 0;
    double slopeLow = 0, slopeHigh = 0;  ///< 95 %, Student's; points are prefixes of one render and so not independent
};

/// Nothing with fewer than three points, or with times or errors that are not positive.
std::optional<PowerLaw> fitPowerLaw(const std::vector<Point>& points);

struct TimeTo {
    double seconds = 0;
    bool extrapolated = false;  ///< beyond what was rendered
};

/// When the error is at most so large and stays so: between measured points on the line through them, beyond the last
/// by the law, up to 100 times as far. Nothing where that does not reach, or where the law does not fall.
std::optional<TimeTo> timeTo(double percent, const std::vector<Point>& points, const std::optional<PowerLaw>& law);

/// Two-sided 95 % quantile of Student's t.
double studentQuantile95(double degreesOfFreedom);

}  // namespace antipode::study
