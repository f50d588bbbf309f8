// The scenes that estimates are held against the truth on.
#pragma once

#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode::test {

struct CalibrationScene {
    std::string name;
    std::string file;       ///< from the project's folder, or from ANTIPODE_SHARED
    bool shared = false;    ///< in ANTIPODE_SHARED
    bool complete = false;  ///< whether bidirectional path tracing finds all of its light
};

/// All that are there.
std::vector<CalibrationScene> calibrationScenes();
Scene load(const CalibrationScene& scene);

}  // namespace antipode::test
