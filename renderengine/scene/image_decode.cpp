#include "scene/image_decode.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "renderengine/error.h"
#include "scene/file_bytes.h"

namespace antipode {
namespace {

/// Larger images are taken for broken headers, before any memory is asked for.
constexpr uint64_t kMaxTexels = uint64_t(1) << 29;

[[noreturn]] void fail(const std::string& name, const std::string& why) {
    throw Error(ErrorCode::Input, "image '" + name + "' cannot be decoded: " + why);
}

void allocate(Texture& texture, uint64_t width, uint64_t height) {
    if (width == 0 || height == 0 || width * height > kMaxTexels)
        fail(texture.name, "its size of " + std::to_string(width) + "×" + std::to_string(height) + " is out of range");
    texture.width = uint32_t(width);
    texture.height = uint32_t(height);
    texture.rgba.resize(width * height * 4);
}

void decodePng(std::span<const uint8_t> data, Texture& texture) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const std::unique_ptr<png_image, decltype(&png_image_free)> guard(&image, png_image_free);
    if (!png_image_begin_read_from_memory(&image, data.data(), data.size())) fail(texture.name, image.message);
    // Without this flag libpng takes 16-bit samples for linear light and encodes them.
    image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    image.format = PNG_FORMAT_RGBA;
    allocate(texture, image.width, image.height);
    // libpng reports a file that was cut short as a warning in some cases, hence the check for both.
    if (!png_image_finish_read(&image, nullptr, texture.rgba.data(), 0, nullptr) || image.warning_or_error != 0)
        fail(texture.name, image.message);
}

void decodeJpeg(std::span<const uint8_t> data, Texture& texture) {
    const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), tjDestroy);
    if (!decoder) fail(texture.name, "no JPEG decoder is available");
    int width = 0, height = 0, subsampling = 0, colorspace = 0;
    if (tjDecompressHeader3(decoder.get(), data.data(), data.size(), &width, &height, &subsampling, &colorspace) != 0)
        fail(texture.name, tjGetErrorStr2(decoder.get()));
    allocate(texture, uint64_t(width), uint64_t(height));
    if (tjDecompress2(decoder.get(), data.data(), data.size(), texture.rgba.data(), width, 0, height, TJPF_RGBA,
                      TJFLAG_ACCURATEDCT) != 0)
        fail(texture.name, tjGetErrorStr2(decoder.get()));
}

}  // namespace

Texture decodeImage(std::span<const uint8_t> data, const std::string& name) {
    Texture texture;
    texture.name = name;
    constexpr uint8_t kPngMagic[] = {0x89, 'P', 'N', 'G'};
    constexpr uint8_t kJpegMagic[] = {0xff, 0xd8, 0xff};
    const auto startsWith = [&](std::span<const uint8_t> magic) {
        return data.size() >= magic.size() && std::equal(magic.begin(), magic.end(), data.begin());
    };
    if (startsWith(kPngMagic))
        decodePng(data, texture);
    else if (startsWith(kJpegMagic))
        decodeJpeg(data, texture);
    else
        fail(name, "it is neither PNG nor JPEG");
    return texture;
}

Texture readTexture(const std::string& path) {
    return decodeImage(readFileBytes(path), std::filesystem::path(path).filename().string());
}

}  // namespace antipode
