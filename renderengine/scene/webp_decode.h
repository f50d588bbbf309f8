// WebP pictures.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// Whether the data begin as WebP does.
bool isWebp(std::span<const uint8_t> data);

/// As decodeImage(). Of an animation, which glTF does not allow, nothing. Throws Error(Input) naming `name`.
Texture decodeWebp(std::span<const uint8_t> data, const std::string& name);

}  // namespace antipode
