// What an image's header may ask for before its data have been looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// False where an image of this size cannot stem from a file of so many bytes: for none at all, for more than 2^29
/// pixels, and for large images with thousands of pixels per byte, which no PNG, JPEG or Radiance picture achieves but
/// a single colour. Keeps a small broken file from asking for gigabytes.
constexpr bool isPlausibleSize(uint64_t width, uint64_t height, size_t fileBytes) {
    constexpr uint64_t kMaxPixels = uint64_t(1) << 29, kAlwaysAllowed = uint64_t(1) << 24, kMaxPixelsPerByte = 1024;
    if (width == 0 || height == 0 || width > kMaxPixels / height) return false;
    return width * height <= kAlwaysAllowed || width * height / kMaxPixelsPerByte <= fileBytes;
}

/// Throws Error(Input): "image 'name' cannot be decoded: why".
[[noreturn]] void failToDecode(const std::string& name, const std::string& why);

/// A texture with memory for its texels. Throws Error(Input) where its size is not plausible.
Texture allocateTexture(const std::string& name, uint64_t width, uint64_t height, size_t fileBytes);

}  // namespace antipode
