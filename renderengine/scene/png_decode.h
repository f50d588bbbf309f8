// PNG as 8-bit RGBA.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// See decodeImage(). Gamma and colour profiles are ignored: values are kept as they are stored.
Texture decodePng(std::span<const uint8_t> data, const std::string& name);

}  // namespace antipode
