// 8-bit sRGB PNG of a linear image.
#include <png.h>

#include "film/image_checks.h"
#include "film/png_bytes.h"
#include "film/tone_curve.h"
#include "renderengine/error.h"
#include "renderengine/io/files.h"
#include "renderengine/pictures.h"

namespace antipode {

std::string pngBytes(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb) {
    // The simplified interface reports errors in the struct; the classic one would longjmp over C++ objects.
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = width;
    png.height = height;
    png.format = PNG_FORMAT_RGB;
    png_alloc_size_t byteCount = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::string bytes(byteCount, '\0');
    if (!png_image_write_to_memory(&png, bytes.data(), &byteCount, 0, rgb.data(), 0, nullptr))
        throw Error(ErrorCode::Output, std::string("Cannot make a PNG: ") + png.message + ".");
    bytes.resize(byteCount);
    return bytes;
}

std::string encodePng(const Image& image) {
    requireConsistent(image, "a PNG");
    std::vector<uint8_t> rgb;
    rgb.reserve(image.pixels.size() * 3);
    for (const Vec3f& pixel : image.pixels) {
        const auto shown = displayPixel(pixel);
        rgb.insert(rgb.end(), shown.begin(), shown.end());
    }
    return pngBytes(image.width, image.height, rgb);
}

void writePng(const std::string& path, const Image& image) {
    requireConsistent(image, path);
    writeFileAtomically(path, encodePng(image));
}

}  // namespace antipode
