// Environment maps from files.
#pragma once

#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// Reads an equirectangular OpenEXR (.exr) or Radiance (.hdr, .pic) picture as a map with factor 1.
/// Throws Error(Input) where the file is missing, broken or of another kind.
Environment readEnvironmentMap(const std::string& path);

}  // namespace antipode
