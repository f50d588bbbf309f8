// TGA and BMP as 8-bit RGBA.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// See decodeImage(). Nothing where the data are neither; TGA has no mark of its own, so that a header which makes
/// sense is taken for one. Throws Error(Input) where they are broken or cut short.
std::optional<Texture> decodeTgaOrBmp(std::span<const uint8_t> data, const std::string& name);

}  // namespace antipode
