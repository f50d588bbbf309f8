// 8-bit sRGB JPEG of a linear image.
#include <memory>

#include <turbojpeg.h>

#include "film/image_checks.h"
#include "film/tone_curve.h"
#include "renderengine/error.h"
#include "renderengine/pictures.h"

namespace antipode {

std::string encodeJpeg(const Image& image, int quality) {
    requireConsistent(image, "a JPEG");
    constexpr uint32_t longestSide = 65500;  // of libjpeg
    if (image.width > longestSide || image.height > longestSide)
        throw Error(ErrorCode::Output, "An image of " + std::to_string(image.width) + "x" +
                                           std::to_string(image.height) +
                                           " pixels is too large for a JPEG: write a PNG.");
    std::vector<uint8_t> rgb;
    rgb.reserve(image.pixels.size() * 3);
    for (const Vec3f& pixel : image.pixels) {
        const auto shown = displayPixel(pixel);
        rgb.insert(rgb.end(), shown.begin(), shown.end());
    }
    const std::unique_ptr<void, int (*)(tjhandle)> compressor(tjInitCompress(), tjDestroy);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    // Full chroma: lamps and glossy edges are small and coloured.
    const bool done = compressor && tjCompress2(compressor.get(), rgb.data(), int(image.width), 0, int(image.height),
                                                TJPF_RGB, &bytes, &size, TJSAMP_444, quality, 0) == 0;
    const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner(bytes, tjFree);
    if (!done)
        throw Error(ErrorCode::Output, std::string("Cannot make a JPEG: ") + tjGetErrorStr2(compressor.get()) + ".");
    return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace antipode
