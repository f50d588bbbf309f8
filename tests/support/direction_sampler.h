// χ² test of a sampler of directions against the density that it claims (pdf per solid angle).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "renderengine/vec.h"
#include "support/random.h"
#include "support/statistics.h"

namespace antipode {

struct DirectionSamplerReport {
    double integral = 0;    ///< ∫ pdf over the sphere: the share of samples that are not empty
    double emptyShare = 0;  ///< share of empty samples
    uint64_t zeroPdf = 0;   ///< samples where the pdf is not positive and finite; must be 0
    TestResult chiSquare;   ///< null hypothesis: counts on a 32 × 64 grid (θ, φ), and the empty ones, follow the pdf
};

/// @param sample  a unit direction, or empty where nothing is sampled
/// @param pdf     its density per solid angle, integrated over every cell adaptively: jumps (rough glass has them) cost
///                time, and are resolved well below the noise of 10⁷ samples
DirectionSamplerReport testDirectionSampler(const std::function<std::optional<Vec3d>(Random&)>& sample,
                                            const std::function<double(const Vec3d&)>& pdf, uint64_t samples,
                                            uint64_t seed);

}  // namespace antipode
