// Hypothesis tests for Monte Carlo results. Every test returns a p-value: the probability, if the null hypothesis
// holds, of a statistic at least as extreme. A test suite that makes m of them compares with bonferroni(alpha, m).
#pragma once

#include <cstdint>
#include <span>

namespace antipode {

// --- Special functions ---

/// Q(a, x) = Γ(a, x)/Γ(a), a > 0, x ≥ 0; relative error about 1e-12 (series and Lentz's continued fraction).
double regularisedGammaQ(double a, double x);
/// I_x(a, b), a, b > 0, 0 ≤ x ≤ 1 (Lentz's continued fraction).
double regularisedBeta(double a, double b, double x);
/// P(|Z| ≥ |z|) for a standard normal Z.
double normalTwoSidedP(double z);
/// P(|T| ≥ |t|) for Student's t with `degreesOfFreedom` > 0.
double studentTwoSidedP(double t, double degreesOfFreedom);
/// P(X ≥ chiSquare) for χ² with `degreesOfFreedom` > 0.
double chiSquareP(double chiSquare, double degreesOfFreedom);

// --- Moments ---

/// Count, mean and variance of a stream of samples (Welford's update).
class Moments {
public:
    void add(double sample);
    uint64_t count() const { return count_; }
    double mean() const { return mean_; }
    /// Unbiased variance of one sample; 0 for fewer than two.
    double variance() const;
    /// Variance of the mean.
    double meanVariance() const;

private:
    uint64_t count_ = 0;
    double mean_ = 0, squares_ = 0;
};

// --- Tests ---

struct TestResult {
    double statistic = 0;
    double degreesOfFreedom = 0;
    double pValue = 1;
};

/// Null hypothesis: the samples' expectation is `expected`. With zero sample variance p is 1 where the mean agrees to
/// 1e-12 relative, else 0. Throws std::invalid_argument for fewer than two samples.
TestResult tTest(const Moments& samples, double expected);

/// Null hypothesis: both expectations are equal; the variances may differ (Welch 1947).
TestResult welchTest(const Moments& a, const Moments& b);

/// Null hypothesis: the counts `observed` have the expectations `expected`. Cells with an expectation below
/// `minimumExpectation` are pooled, smallest first, until every pool reaches it; a rest joins the last pool. A count in
/// a cell of expectation 0 gives p = 0. Degrees of freedom: cells left − 1 (the total is taken as given). Throws
/// std::invalid_argument where sizes differ or fewer than two cells are left.
TestResult chiSquareTest(std::span<const double> observed, std::span<const double> expected,
                         double minimumExpectation = 5);

/// Significance of each of `tests` tests so that a false alarm among all of them has probability ≤ alpha.
double bonferroni(double alpha, uint64_t tests);
/// The same for independent tests: 1 − (1 − alpha)^(1/tests).
double sidak(double alpha, uint64_t tests);

/// Least squares of log y = intercept + slope·log x.
struct LogLogFit {
    double slope = 0, intercept = 0;
    double slopeError = 0;  ///< standard error of the slope, from the residuals; 0 for two points
};

/// Throws std::invalid_argument for fewer than two points, different sizes, or values that are not positive.
LogLogFit fitLogLog(std::span<const double> x, std::span<const double> y);

}  // namespace antipode
