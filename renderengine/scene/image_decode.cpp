#include "scene/image_decode.h"

#include <turbojpeg.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "renderengine/io/files.h"
#include "renderengine/film.h"
#include "scene/float_texture.h"
#include "scene/image_size.h"
#include "scene/png_decode.h"
#include "scene/radiance_hdr.h"
#include "scene/stb_decode.h"
#include "scene/webp_decode.h"

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

bool startsWith(std::span<const uint8_t> data, std::span<const uint8_t> magic) {
    return data.size() >= magic.size() && std::equal(magic.begin(), magic.end(), data.begin());
}

}  // namespace

Texture decodeImage(std::span<const uint8_t> data, const std::string& name) {
    constexpr uint8_t kPngMagic[] = {0x89, 'P', 'N', 'G'}, kJpegMagic[] = {0xff, 0xd8, 0xff};
    if (startsWith(data, kPngMagic)) return decodePng(data, name);
    if (startsWith(data, kJpegMagic)) return decodeJpeg(data, name);
    if (isWebp(data)) return decodeWebp(data, name);
    if (std::optional<Texture> texture = decodeTgaOrBmp(data, name)) return std::move(*texture);
    failToDecode(name, "it is neither PNG, JPEG, WebP, TGA nor BMP");
}

Texture readTexture(const std::string& path, bool srgb, std::vector<std::string>& notices) {
    constexpr uint8_t kExrMagic[] = {0x76, 0x2f, 0x31, 0x01}, kRadianceMagic[] = {'#', '?'};
    const std::vector<uint8_t> data = readFileBytes(path);
    const std::string name = std::filesystem::path(path).filename().string();
    if (startsWith(data, kExrMagic)) return toTexture(readExr(path), name, srgb, notices);
    if (startsWith(data, kRadianceMagic)) return toTexture(decodeRadianceHdr(data, name), name, srgb, notices);
    return decodeImage(data, name);
}

}  // namespace antipode
