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
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config) || WebPGetFeatures(data.data(), data.size(), &config.input) != VP8_STATUS_OK)
        failToDecode(name, "its WebP header is broken");
    const int width = config.input.width, height = config.input.height;
    Texture texture = allocateTexture(name, uint64_t(width), uint64_t(height), data.size());
    // Colours of lossy files are as coarse as two pixels. Smoothed before they meet the luminance, one bleeds into the
    // next: red beside green ends in a brown that is in neither.
    config.options.no_fancy_upsampling = 1;
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {texture.rgba.data(), width * 4, texture.rgba.size()};
    if (WebPDecode(data.data(), data.size(), &config) != VP8_STATUS_OK)
        failToDecode(name, "its WebP data are damaged or cut short");
    return texture;
}

}  // namespace antipode
