// The axes of the tables of losses (loss_tables.h), as lib/losses.glsl has them.
#pragma once

#include <cmath>

namespace antipode {

/// Losses change where the cosine is about α, and steeply near 0: positions in [0,1] along the cosine are even in
/// √(μ(1 + 3α)/(μ + 3α)).
inline double lossColumn(double cosine, double alpha) {
    return std::sqrt(cosine * (1 + 3 * alpha) / (cosine + 3 * alpha));
}
inline double cosineOfLossColumn(double column, double alpha) {
    const double x = column * column;
    return 3 * alpha * x / (1 + 3 * alpha - x);
}

/// Of glass: the root of its reflectance at normal incidence, in [0,1); eta above 1.
inline double lossIndex(double eta) { return (eta - 1) / (eta + 1); }
inline double etaOfLossIndex(double index) { return (1 + index) / (1 - index); }

}  // namespace antipode
