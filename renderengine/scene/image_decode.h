// Pictures as 8-bit RGBA, from a file or from memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

/// Decodes by content, not by file name. Sample values are kept as they are stored; whether they are sRGB-encoded is
/// the caller's knowledge. 16-bit samples lose their lower byte. Throws Error(Input) naming `name` where the data are
/// neither PNG, JPEG, WebP, TGA nor BMP, or broken, or cut short.
Texture decodeImage(std::span<const uint8_t> data, const std::string& name);

/// The same for a file, which may also be OpenEXR or Radiance: those are linear, and become sRGB-encoded where `srgb`
/// says so; what does not fit in 8 bits is said in `notices`. Throws Error(Input) where the file is missing, too.
Texture readTexture(const std::string& path, bool srgb, std::vector<std::string>& notices);

}  // namespace antipode
