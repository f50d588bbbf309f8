#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace antipode {
namespace {

constexpr double kTiny = 1e-300;  // keeps Lentz's denominators from zero
constexpr int kMaxTerms = 100000;
constexpr double kConverged = 1e-15;

double lentzGuard(double x) { return std::abs(x) < kTiny ? kTiny : x; }

/// P(a, x) by its power series, good for x < a + 1.
double gammaSeriesP(double a, double x) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < kMaxTerms && std::abs(term) > std::abs(sum) * kConverged; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Q(a, x) by its continued fraction, good for x ≥ a + 1 (Press et al., Numerical Recipes, 6.2).
double gammaFractionQ(double a, double x) {
    double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, h = d;
    for (int i = 1; i < kMaxTerms; ++i) {
        const double an = -i * (i - a);
        b += 2;
        d = 1 / lentzGuard(an * d + b);
        c = lentzGuard(b + an / c);
        h *= d * c;
        if (std::abs(d * c - 1) < kConverged) break;
    }
    return h * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// The continued fraction of I_x(a, b) (Press et al., Numerical Recipes, 6.4).
double betaFraction(double a, double b, double x) {
    double c = 1, d = 1 / lentzGuard(1 - (a + b) * x / (a + 1)), h = d;
    for (int m = 1; m < kMaxTerms; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / lentzGuard(1 + even * d);
        c = lentzGuard(1 + even / c);
        h *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / lentzGuard(1 + odd * d);
        c = lentzGuard(1 + odd / c);
        h *= d * c;
        if (std::abs(d * c - 1) < kConverged) break;
    }
    return h;
}

void require(bool condition, const char* message) {
    if (!condition) throw std::invalid_argument(message);
}

}  // namespace

double regularisedGammaQ(double a, double x) {
    if (x <= 0) return 1;
    return x < a + 1 ? 1 - gammaSeriesP(a, x) : gammaFractionQ(a, x);
}

double regularisedBeta(double a, double b, double x) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    // The fraction converges fast only below the mean; above it the symmetry I_x(a,b) = 1 − I_{1−x}(b,a) is used.
    if (x < (a + 1) / (a + b + 2)) return front * betaFraction(a, b, x) / a;
    return 1 - front * betaFraction(b, a, 1 - x) / b;
}

double normalTwoSidedP(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double studentTwoSidedP(double t, double degreesOfFreedom) {
    if (!std::isfinite(t)) return 0;
    return regularisedBeta(degreesOfFreedom / 2, 0.5, degreesOfFreedom / (degreesOfFreedom + t * t));
}

double chiSquareP(double chiSquare, double degreesOfFreedom) {
    return regularisedGammaQ(degreesOfFreedom / 2, chiSquare / 2);
}

void Moments::add(double sample) {
    ++count_;
    const double delta = sample - mean_;
    mean_ += delta / double(count_);
    squares_ += delta * (sample - mean_);
}

double Moments::variance() const { return count_ < 2 ? 0 : squares_ / double(count_ - 1); }

double Moments::meanVariance() const { return count_ == 0 ? 0 : variance() / double(count_); }

namespace {

/// Student's test of a difference with the given variance.
TestResult studentTest(double difference, double variance, double degreesOfFreedom, double magnitude) {
    if (variance == 0) {
        const bool equal = std::abs(difference) <= 1e-12 * magnitude;
        return {equal ? 0 : std::numeric_limits<double>::infinity(), degreesOfFreedom, equal ? 1.0 : 0.0};
    }
    const double t = difference / std::sqrt(variance);
    // A NaN must fail the test, not slip through a comparison.
    return {t, degreesOfFreedom, std::isnan(t) ? 0.0 : studentTwoSidedP(t, degreesOfFreedom)};
}

}  // namespace

TestResult tTest(const Moments& samples, double expected) {
    require(samples.count() >= 2, "tTest needs at least two samples");
    return studentTest(samples.mean() - expected, samples.meanVariance(), double(samples.count() - 1),
                       std::abs(expected));
}

TestResult welchTest(const Moments& a, const Moments& b) {
    require(a.count() >= 2 && b.count() >= 2, "welchTest needs at least two samples on both sides");
    const double va = a.meanVariance(), vb = b.meanVariance(), sum = va + vb;
    const double spread = va * va / double(a.count() - 1) + vb * vb / double(b.count() - 1);
    const double degreesOfFreedom = spread > 0 ? sum * sum / spread : double(a.count() + b.count() - 2);
    return studentTest(a.mean() - b.mean(), sum, degreesOfFreedom, std::max(std::abs(a.mean()), std::abs(b.mean())));
}

TestResult chiSquareTest(std::span<const double> observed, std::span<const double> expected,
                         double minimumExpectation) {
    require(observed.size() == expected.size(), "chiSquareTest needs one expectation per count");
    struct Cell {
        double observed, expected;
    };
    std::vector<Cell> cells;
    for (size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] > 0) {
            cells.push_back({observed[i], expected[i]});
        } else if (observed[i] != 0) {
            return {std::numeric_limits<double>::infinity(), 1, 0};
        }
    }
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.expected < b.expected; });

    std::vector<Cell> pooled;
    Cell pool{0, 0};
    for (const Cell& cell : cells) {
        pool.observed += cell.observed;
        pool.expected += cell.expected;
        if (pool.expected >= minimumExpectation) {
            pooled.push_back(pool);
            pool = {0, 0};
        }
    }
    require(pooled.size() >= 2, "chiSquareTest needs at least two cells after pooling");
    pooled.back().observed += pool.observed;
    pooled.back().expected += pool.expected;

    TestResult result{0, double(pooled.size() - 1), 0};
    for (const Cell& cell : pooled) {
        const double difference = cell.observed - cell.expected;
        result.statistic += difference * difference / cell.expected;
    }
    result.pValue = chiSquareP(result.statistic, result.degreesOfFreedom);
    return result;
}

double bonferroni(double alpha, uint64_t tests) { return alpha / double(tests); }

double sidak(double alpha, uint64_t tests) { return -std::expm1(std::log1p(-alpha) / double(tests)); }

LogLogFit fitLogLog(std::span<const double> x, std::span<const double> y) {
    require(x.size() == y.size() && x.size() >= 2, "fitLogLog needs two or more points");
    const double n = double(x.size());
    double meanX = 0, meanY = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        require(x[i] > 0 && y[i] > 0, "fitLogLog needs positive values");
        meanX += std::log(x[i]) / n;
        meanY += std::log(y[i]) / n;
    }
    double sxx = 0, sxy = 0, residuals = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double dx = std::log(x[i]) - meanX;
        sxx += dx * dx;
        sxy += dx * (std::log(y[i]) - meanY);
    }
    LogLogFit fit;
    fit.slope = sxy / sxx;
    fit.intercept = meanY - fit.slope * meanX;
    for (size_t i = 0; i < x.size(); ++i) {
        const double residual = std::log(y[i]) - fit.intercept - fit.slope * std::log(x[i]);
        residuals += residual * residual;
    }
    if (x.size() > 2) fit.slopeError = std::sqrt(residuals / (n - 2) / sxx);
    return fit;
}

}  // namespace antipode
