// How a render's error has come down, in few points.
#pragma once

#include <cstdint>
#include <vector>

#include "renderengine/error_estimate.h"

namespace antipode::view {

/// An estimate and when it was made.
struct ErrorPoint {
    double seconds = 0;  ///< of rendering, > 0
    uint64_t iterations = 0;
    double percent = 0, low = 0, high = 0;  ///< see ErrorEstimate
};

/// Keeps the first estimate, the latest, and in between one for each twentieth by which time grows: some 280 for a
/// render from a tenth of a second to a day.
class ErrorHistory {
public:
    /// Time does not decrease. Estimates of nothing, or before any time has passed, are left out: they are in no
    /// logarithmic plot.
    void add(double seconds, const ErrorEstimate& estimate);
    const std::vector<ErrorPoint>& points() const { return points_; }

private:
    std::vector<ErrorPoint> points_;
};

}  // namespace antipode::view
