#include "scene/webp_decode.h"

#include <webp/decode.h>

#include <algorithm>
#include <string_view>

#include "scene/image_size.h"

namespace antipode {

bool isWebp(std::span<const uint8_t> data) {
    constexpr std::string_view riff = "RIFF", webp = "WEBP";
    return data.size() >= 12 && std::equal(riff.begin(), riff.end(), data.begin()) &&
           std::equal(webp.begin(), webp.end(), data.begin() + 8);
}

Texture decodeWebp(std::span<const uint8_t> data, const std::string& name) {
    int width = 0, height = 0;
    if (!WebPGetInfo(data.data(), data.size(), &width, &height)) failToDecode(name, "its WebP header is broken");
    Texture texture = allocateTexture(name, uint64_t(width), uint64_t(height), data.size());
    if (!WebPDecodeRGBAInto(data.data(), data.size(), texture.rgba.data(), texture.rgba.size(), width * 4))
        failToDecode(name, "its WebP data are damaged or cut short");
    return texture;
}

}  // namespace antipode
