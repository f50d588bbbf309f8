#include "client/error_forecast.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace antipode {
namespace {

constexpr uint64_t leastIterations = 8;  // before, four classes have one iteration each
constexpr size_t leastPoints = 3, mostPoints = 6;
constexpr double normalQuantile = 1.96;

}  // namespace

void ErrorForecast::add(const ErrorEstimate& estimate) {
    latest_ = estimate;
    if (estimate.iterations >= leastIterations && estimate.percent > 0)
        doublings_.emplace(std::bit_width(estimate.iterations), estimate);
}

std::optional<ErrorForecast::Fit> ErrorForecast::fit() const {
    std::vector<std::pair<double, double>> points;
    const auto put = [&](const ErrorEstimate& e) {
        points.emplace_back(std::log(double(e.iterations)), std::log(e.percent));
    };
    for (const auto& [octave, estimate] : doublings_) put(estimate);
    // The latest counts, too, once it is well beyond the last doubling.
    if (!doublings_.empty() && 2 * latest_->iterations >= 3 * doublings_.rbegin()->second.iterations) put(*latest_);
    if (points.size() > mostPoints) points.erase(points.begin(), points.end() - mostPoints);
    if (points.size() < leastPoints) return std::nullopt;
    double meanX = 0, meanY = 0, xx = 0, xy = 0, yy = 0;
    for (const auto& [x, y] : points) meanX += x / double(points.size()), meanY += y / double(points.size());
    for (const auto& [x, y] : points) {
        xx += (x - meanX) * (x - meanX);
        xy += (x - meanX) * (y - meanY);
        yy += (y - meanY) * (y - meanY);
    }
    const double residual = std::max(yy - xy * xy / xx, 0.0) / double(points.size() - 2);
    return Fit{-xy / xx, std::sqrt(residual / xx)};
}

std::optional<double> ErrorForecast::exponent() const {
    const std::optional<Fit> fitted = fit();
    return fitted ? std::optional(fitted->exponent) : std::nullopt;
}

std::optional<ErrorForecast::Iterations> ErrorForecast::iterationsTo(double percent) const {
    const std::optional<Fit> fitted = fit();
    if (!fitted || fitted->exponent <= 2 * fitted->standardError || percent >= latest_->percent) return std::nullopt;
    const double gap = std::log(latest_->percent / percent), b = fitted->exponent;
    const double ofError = std::log(latest_->high / latest_->low) / (2 * normalQuantile) / b;
    const double ofExponent = gap / (b * b) * fitted->standardError;
    const double expected = double(latest_->iterations) * std::exp(gap / b);
    return Iterations{expected, expected * std::expm1(normalQuantile * std::hypot(ofError, ofExponent))};
}

double nextMark(double percent) {
    double mark = 50;
    while (true)
        for (const double factor : {1.0, 0.4, 0.2}) {
            if (mark * factor < percent * 0.999) return mark * factor;
            if (factor == 0.2) mark /= 10;
        }
}

}  // namespace antipode
