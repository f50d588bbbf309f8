// PNG and JPEG files as 8-bit RGBA, from a file or from memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// Decodes by content, not by file name. Sample values are kept as they are stored; whether they are sRGB-encoded is
/// the caller's knowledge. 16-bit samples lose their lower byte. Throws Error(Input) naming `name` where the data are
/// neither PNG nor JPEG, or broken, or cut short.
Texture decodeImage(std::span<const uint8_t> data, const std::string& name);

/// The same for a file. Throws Error(Input) where it is missing.
Texture readTexture(const std::string& path);

}  // namespace antipode
