#include "scene/image_decode.h"

#include <turbojpeg.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "renderengine/io/files.h"
#include "scene/image_size.h"
#include "scene/png_decode.h"

namespace antipode {
namespace {

Texture decodeJpeg(std::span<const uint8_t> data, const std::string& name) {
    const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), tjDestroy);
    if (!decoder) failToDecode(name, "no JPEG decoder is available");
    int width = 0, height = 0, subsampling = 0, colorspace = 0;
    if (tjDecompressHeader3(decoder.get(), data.data(), data.size(), &width, &height, &subsampling, &colorspace) != 0)
        failToDecode(name, tjGetErrorStr2(decoder.get()));
    if (colorspace == TJCS_CMYK || colorspace == TJCS_YCCK)
        failToDecode(name, "its colours are CMYK, for printing; convert it to RGB");
    Texture texture = allocateTexture(name, uint64_t(width), uint64_t(height), data.size());
    if (tjDecompress2(decoder.get(), data.data(), data.size(), texture.rgba.data(), width, 0, height, TJPF_RGBA,
                      TJFLAG_ACCURATEDCT) != 0)
        failToDecode(name, tjGetErrorStr2(decoder.get()));
    return texture;
}

}  // namespace

Texture decodeImage(std::span<const uint8_t> data, const std::string& name) {
    constexpr uint8_t kPngMagic[] = {0x89, 'P', 'N', 'G'};
    constexpr uint8_t kJpegMagic[] = {0xff, 0xd8, 0xff};
    const auto startsWith = [&](std::span<const uint8_t> magic) {
        return data.size() >= magic.size() && std::equal(magic.begin(), magic.end(), data.begin());
    };
    if (startsWith(kPngMagic)) return decodePng(data, name);
    if (startsWith(kJpegMagic)) return decodeJpeg(data, name);
    failToDecode(name, "it is neither PNG nor JPEG");
}

Texture readTexture(const std::string& path) {
    return decodeImage(readFileBytes(path), std::filesystem::path(path).filename().string());
}

}  // namespace antipode
