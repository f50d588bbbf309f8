// What a knob costs and what it buys. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/study/fit.h"
#include "client/study/study.h"

namespace antipode::study {

/// Whether the reference's own noise is more than a quarter of what was measured: such points tell of the reference.
/// `own`: its error as its classes tell it, for an outlier of the reference excuses itself in its own denominator.
bool limitedByReference(const Snapshot& snapshot, const std::optional<Interval>& own);

/// The snapshots that tell of the variant, by one of its clocks.
std::vector<Point> pointsOf(const VariantResult& result, const std::optional<Interval>& own, double Snapshot::*clock);

/// A variant against another after as many iterations of either. Intervals are of 95 %.
struct Price {
    std::string variant, label, against;
    uint64_t iterations = 0;
    Interval time;       ///< CPU seconds of an iteration, ratio
    Interval error;      ///< √relMSE, ratio; NaN where the reference is not good enough
    Interval sameError;  ///< time to the same error, were relMSE ∝ 1/time: time·error²; their intervals joined
};

std::vector<Price> prices(const SceneResult& scene);

/// "Double precision: 1.93 × the time of vcm (1.9 to 1.96) and 1 × its error (0.998 to 1) after 64 iterations; …".
std::string sentence(const Price& price);

}  // namespace antipode::study
