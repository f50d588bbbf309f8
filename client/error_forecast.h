// When a render will have become how accurate.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "renderengine/error_estimate.h"

namespace antipode {

/// Follows error ∝ n^−b over the number of iterations n, b being fitted: it is ½ for noise alone, and less where
/// merging makes noise and blur (1/3 at α = 2/3).
class ErrorForecast {
public:
    struct Iterations {
        double expected = 0;
        double spread = 0;  ///< half of the 95 % interval
    };

    /// The estimate of what is rendered; n does not decrease.
    void add(const ErrorEstimate& estimate);
    /// −d log error/d log n, by least squares over the latest doublings; nothing before there are three.
    std::optional<double> exponent() const;
    /// When the error will be `percent`, which it is not yet. Nothing where it cannot be told.
    std::optional<Iterations> iterationsTo(double percent) const;
    const std::optional<ErrorEstimate>& latest() const { return latest_; }

private:
    struct Fit {
        double exponent, standardError;
    };
    std::optional<Fit> fit() const;

    std::optional<ErrorEstimate> latest_;
    std::map<uint64_t, ErrorEstimate> doublings_;  ///< by ⌊log2 n⌋, the first that was seen
};

/// The error that people want to hear the time of next: of 50, 20, 10, 5 … percent the largest below `percent`.
double nextMark(double percent);

}  // namespace antipode
