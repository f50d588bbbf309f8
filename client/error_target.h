// When a render that is asked for an error looks whether it is there.
#pragma once

#include <cstdint>
#include <optional>

#include "renderengine/error_estimate.h"

namespace antipode {

/// At numbers of iterations that follow from the estimates of all iterations before, and from nothing else: it ends
/// after the same iteration on any farm. Nothing is rendered beyond the next check before that is made.
class ErrorTarget {
public:
    /// `percent` > 0. With `rendered` iterations there already, those are looked at first.
    ErrorTarget(double percent, uint64_t rendered);

    /// The number of iterations, from the first on, to look at next.
    uint64_t check() const { return check_; }
    /// The estimate of just those. True where the render may end: the error is at most what was asked for, and the
    /// interval ends at most a fifth above. A doubtful estimate has to say so again after twice the iterations, when
    /// rare bright samples that it missed may have come. Otherwise moves the check on: to where the error will be at
    /// 1/√n, by an eighth at least and to the double at most.
    bool reached(const std::optional<ErrorEstimate>& estimate);

private:
    double percent_;
    uint64_t check_;
    std::optional<uint64_t> confirmation_;  ///< where a doubtful estimate may end it
};

}  // namespace antipode
