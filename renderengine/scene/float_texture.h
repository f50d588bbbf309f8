// OpenEXR and Radiance pictures as textures of 8 bits.
#pragma once

#include <string>
#include <vector>

#include "renderengine/film.h"
#include "renderengine/scene.h"

namespace antipode {

/// The picture's values, opaque, rounded to 8 bits: sRGB-encoded or, for data, as they are. What lies outside [0,1] is
/// cut off, with a notice. Throws Error(Input) where a value is not finite.
Texture toTexture(const Image& image, const std::string& name, bool srgb, std::vector<std::string>& notices);

}  // namespace antipode
