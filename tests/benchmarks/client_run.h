// The client as a process of its own: what only a fresh process can show.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/benchmarks/clock.h"

namespace antipode::benchmark {

struct ClientRun {
    Duration duration;     ///< from the process' start to its end
    nlohmann::json stats;  ///< what --stats wrote
};

/// Runs `antipode render SCENE ARGUMENTS` in the folder, which takes the images and is where drivers keep their shader
/// caches, in `cacheName`; the arguments are shell text. Throws Error(Device) where the client fails.
ClientRun renderWithClient(const std::string& folder, const std::string& cacheName, const std::string& scene,
                           const std::string& arguments, const std::string& device);

}  // namespace antipode::benchmark
