// Environment maps from files.
#pragma once

#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// Reads an equirectangular OpenEXR (.exr) or Radiance (.hdr, .pic) picture, suffixes in any case, as
/// a map with factor 1. Throws Error(Input) where the file is missing, broken or of another kind, or names the texel
/// that is not finite.
Environment readEnvironmentMap(const std::string& path);

}  // namespace antipode
