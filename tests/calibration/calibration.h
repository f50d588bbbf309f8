// What renders of many seeds told of their error, against what they err by.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "tests/calibration/runs.h"

namespace antipode::test {

/// Shares of 1: of `tries`, how many held.
struct Count {
    uint64_t hits = 0, tries = 0;

    double share() const { return tries ? double(hits) / double(tries) : 0; }
    Count& operator+=(const Count& o) { return hits += o.hits, tries += o.tries, *this; }
};

/// P(X ≤ hits) where each of the tries held with probability p.
double binomialBelow(const Count& count, double p);
/// The 95 % interval of the probability (Clopper & Pearson 1934).
std::pair<double, double> binomialInterval(const Count& count);

/// The value below which a share of the values lies, 0 ≤ share ≤ 1; they are not empty. Linear between two.
double quantile(std::vector<double> values, double share);

/// Of one scene and technique. Errors are √relMSE in percent, as `antipode compare` measures them.
///
/// *Noise* of a run is its distance from the technique's expectation. For want of that it is taken from the mean of the
/// other S − 1 runs after as many iterations, whose own noise makes its square S/(S − 1) times too large, which is
/// taken off. So it is free of what all runs have in common: bias, and light that no run has met. What it is relative
/// to is the mean of all runs and iterations.
class Calibration {
public:
    /// Of two runs at least, all as long.
    explicit Calibration(std::vector<Followed> runs);

    size_t runs() const { return runs_.size(); }
    uint64_t iterations() const { return runs_[0].images.size() - 1; }
    const Followed& run(size_t s) const { return runs_[s]; }

    /// Of run s after n iterations.
    double noise(size_t s, uint64_t n) const { return noise_[s][n]; }
    /// The root of the mean square over all runs.
    double noise(uint64_t n) const;
    /// −d log noise/d log n over the second half of the iterations.
    double exponent() const;

    /// Estimates after n iterations whose interval held the noise; of runs that `counts` wants.
    using Counts = std::function<bool(const ErrorEstimate&)>;
    Count held(
        uint64_t n, const Counts& counts = [](const ErrorEstimate&) { return true; }) const;
    /// Those whose interval lay above the noise.
    Count toldTooHigh(uint64_t n) const;
    /// Told over true after n iterations, one a run.
    std::vector<double> ratios(uint64_t n) const;

    /// Iterations until a run's noise comes to `percent`, between whole ones; beyond the last by the exponent.
    double iterationsTo(size_t s, double percent) const;

    /// Means of all runs after n iterations.
    const std::vector<double>& mean(uint64_t n) const { return means_[n]; }
    /// How far the mean of all runs is off, in percent: noise(n)/√runs.
    double meanNoise(uint64_t n) const;

private:
    std::vector<Followed> runs_;
    std::vector<std::vector<double>> means_, noise_;
};

/// How far the means of two techniques lie apart, less their noise: √relMSE in percent of a against b, and the standard
/// error of its square's root where it is none. A negative square is 0.
struct Bias {
    double percent = 0;
    double doubt = 0;  ///< what noise alone might show
};
Bias biasOf(const Calibration& a, uint64_t n, const Calibration& b);

/// What a forecast after n iterations said of a target, against what came.
struct ForecastMiss {
    double ofTotal = 0;      ///< |predicted − true| in shares of the true number of iterations
    double ofRemaining = 0;  ///< in shares of the true number that was still missing
    double ofSeconds = 0;    ///< in CPU seconds, of the total
    bool held = false;       ///< whether the stated spread held it
};

/// Of the runs that told anything: to the target of `factor` times what each told after n iterations.
std::vector<ForecastMiss> forecastMisses(const Calibration& calibration, uint64_t n, double factor);

/// Where `--target-error` ends.
struct TargetEnd {
    uint64_t iterations = 0;
    double noise = 0;  ///< in percent
};
/// Of the runs that end at all.
std::vector<TargetEnd> targetEnds(const Calibration& calibration, double percent);

}  // namespace antipode::test
