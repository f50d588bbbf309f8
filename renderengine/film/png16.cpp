// 16-bit sRGB PNG of a linear image.
#include <png.h>

#include <csetjmp>

#include "film/image_checks.h"
#include "film/tone_curve.h"
#include "renderengine/error.h"
#include "renderengine/pictures.h"

namespace antipode {
namespace {

struct PngOutput {
    std::string bytes, failure;
};

extern "C" void appendPng(png_structp png, png_bytep data, size_t size) {
    static_cast<PngOutput*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), size);
}

extern "C" void flushPng(png_structp) {}

extern "C" void failPng(png_structp png, png_const_charp message) {
    static_cast<PngOutput*>(png_get_error_ptr(png))->failure = message;
    png_longjmp(png, 1);
}

/// libpng's simplified interface writes 16 bits as linear light only, which viewers show too dark. An error jumps out
/// of here, over no object that has a destructor. `rgb`: 6 bytes a pixel, high byte first.
bool encode(uint32_t width, uint32_t height, const uint8_t* rgb, PngOutput& output) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, failPng, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    const bool ready = png && info;
    if (!ready || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, &output, appendPng, flushPng);
    png_set_IHDR(png, info, width, height, 16, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (uint32_t row = 0; row < height; ++row) png_write_row(png, rgb + size_t(6) * width * row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
}

}  // namespace

std::string encodePng16(const Image& image) {
    requireConsistent(image, "a PNG");
    std::vector<uint8_t> rgb;
    rgb.reserve(image.pixels.size() * 6);
    for (const Vec3f& pixel : image.pixels)
        for (const uint16_t shown : displayPixel16(pixel)) {
            rgb.push_back(uint8_t(shown >> 8));
            rgb.push_back(uint8_t(shown));
        }
    PngOutput output;
    if (!encode(image.width, image.height, rgb.data(), output))
        throw Error(ErrorCode::Output, "Cannot make a PNG: " + output.failure + ".");
    return std::move(output.bytes);
}

}  // namespace antipode
