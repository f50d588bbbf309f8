// Renders of one scene with one technique and many seeds, followed iteration by iteration: what the client would have
// told of their error, and what is true.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderengine/error_estimate.h"
#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode::test {

/// Of one seed. Images are row-major RGB.
struct Run {
    std::vector<std::vector<float>> iterations;  ///< the image of each
    std::vector<double> cpuSeconds;              ///< of each
};

/// Renders iterations 1 to `count`. With a folder `keep` (not ""), what lies there is read instead, and what is
/// rendered is left there; `name` tells scenes apart. Throws Error, and where an event was counted.
Run renderRun(const Scene& scene, const std::string& name, const RenderSettings& settings, uint64_t count,
              const std::string& keep);

/// A run as the client sees it. Index n stands for the first n iterations; 0 is empty.
struct Followed {
    std::vector<std::vector<float>> images;
    std::vector<std::optional<ErrorEstimate>> told;
    std::vector<double> cpuSeconds;  ///< of all of them together
};

Followed follow(const Run& run, uint32_t width, uint32_t height);

}  // namespace antipode::test
