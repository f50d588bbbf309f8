// 8-bit sRGB PNG of a linear image.
#include <png.h>

#include "film/image_checks.h"
#include "film/tone_curve.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "renderengine/io/files.h"

namespace antipode {

void writePng(const std::string& path, const Image& image) {
    requireConsistent(image, path);
    std::vector<uint8_t> rgb;
    rgb.reserve(image.pixels.size() * 3);
    for (const Vec3f& pixel : image.pixels) {
        const auto shown = displayPixel(pixel);
        rgb.insert(rgb.end(), shown.begin(), shown.end());
    }

    // The simplified interface reports errors in the struct; the classic one would longjmp over C++ objects.
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = image.width;
    png.height = image.height;
    png.format = PNG_FORMAT_RGB;
    png_alloc_size_t byteCount = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::string bytes(byteCount, '\0');
    if (!png_image_write_to_memory(&png, bytes.data(), &byteCount, 0, rgb.data(), 0, nullptr))
        throw Error(ErrorCode::Output, "Cannot write '" + path + "': " + png.message + ".");
    bytes.resize(byteCount);
    writeFileAtomically(path, bytes);
}

}  // namespace antipode
