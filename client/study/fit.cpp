#include "client/study/fit.h"

#include <cmath>

namespace antipode::study {

// Cornish–Fisher expansion about the normal quantile (Abramowitz & Stegun 26.7.5); to 1 % from three degrees of freedom
// on. Below, exact: tan and the closed form of two.
double studentQuantile95(double n) {
    if (n < 1.5) return 12.706205;
    if (n < 2.5) return 4.302653;
    constexpr double z = 1.959963985;
    const double z2 = z * z;
    return z * (1 + (z2 + 1) / (4 * n) + ((5 * z2 + 16) * z2 + 3) / (96 * n * n) +
                (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * n * n * n));
}

std::optional<PowerLaw> fitPowerLaw(const std::vector<Point>& points) {
    const double n = double(points.size());
    if (n < 3) return std::nullopt;
    double meanX = 0, meanY = 0;
    for (const Point& point : points) {
        if (!(point.seconds > 0) || !(point.percent > 0)) return std::nullopt;
        meanX += std::log(point.seconds) / n;
        meanY += std::log(point.percent) / n;
    }
    double xx = 0, xy = 0, yy = 0;
    for (const Point& point : points) {
        const double x = std::log(point.seconds) - meanX, y = std::log(point.percent) - meanY;
        xx += x * x, xy += x * y, yy += y * y;
    }
    if (!(xx > 0)) return std::nullopt;
    PowerLaw law;
    law.slope = xy / xx;
    law.scale = std::exp(meanY - law.slope * meanX);
    const double residual = std::max(yy - law.slope * xy, 0.0);
    const double half = studentQuantile95(n - 2) * std::sqrt(residual / (n - 2) / xx);
    law.slopeLow = law.slope - half;
    law.slopeHigh = law.slope + half;
    return law;
}

std::optional<TimeTo> timeTo(double percent, const std::vector<Point>& points, const std::optional<PowerLaw>& law) {
    constexpr double farthest = 100;
    if (points.empty()) return std::nullopt;
    if (points.back().percent > percent) {
        if (!law || law->slopeHigh >= 0) return std::nullopt;
        // From the last point on, with the law's slope: the law itself need not pass through it.
        const double seconds = points.back().seconds * std::pow(percent / points.back().percent, 1 / law->slope);
        if (seconds > farthest * points.back().seconds) return std::nullopt;
        return TimeTo{seconds, true};
    }
    size_t first = points.size() - 1;
    while (first > 0 && points[first - 1].percent <= percent) --first;
    if (first == 0) return TimeTo{points[0].seconds, false};
    const Point &before = points[first - 1], &after = points[first];
    const double share = std::log(percent / before.percent) / std::log(after.percent / before.percent);
    return TimeTo{before.seconds * std::pow(after.seconds / before.seconds, share), false};
}

}  // namespace antipode::study
