// What SmallVCM takes and reaches on the same scenes (Davidovič and Georgiev's reference implementation, -O3
// -march=native, 2 cores).
#pragma once

#include <array>
#include <optional>

namespace antipode::benchmark {

/// In the order of SmallVCM's own options.
constexpr std::array<const char*, 6> comparedTechniques{"pt", "lt", "ppm", "bpm", "bpt", "vcm"};

struct CornellScene {
    const char* name;  ///< of scenes/cornell/NAME.textproto
    const char* contents;
    std::array<double, 6> cpuMilliseconds;  ///< per iteration at 512², lowest of 6 runs; medians are 10–25 % higher
    std::array<std::optional<double>, 6> relMse;  ///< after about 12 CPU-seconds at 256²
};

constexpr std::array<CornellScene, 4> cornellScenes{{
    {"sun", "mirror + glass, sun", {346, 192, 368, 1032, 717, 1217}, {}},
    {"area", "large mirror sphere, area light", {355, 383, 485, 1453, 982, 1950}, {.157, {}, .089, .041, .038, .0093}},
    {"point", "mirror + glass, point light", {282, 285, 458, 1370, 815, 1487}, {}},
    {"sky", "mirror + glass, constant environment", {373, 159, 322, 832, 626, 1155}, {.0087, {}, {}, {}, .0112, .0147}},
}};

}  // namespace antipode::benchmark
