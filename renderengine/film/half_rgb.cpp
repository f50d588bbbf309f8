#include "numerics/half.h"
#include "renderengine/pictures.h"

namespace antipode {

std::string encodeHalfRgb(const Image& image, double factor) {
    std::string bytes;
    bytes.reserve(6 * image.pixels.size());
    const auto put = [&](float value) {
        const uint16_t half = toHalf(float(double(value) * factor));
        bytes += char(half & 0xFF);
        bytes += char(half >> 8);
    };
    for (const Vec3f& pixel : image.pixels) put(pixel.x), put(pixel.y), put(pixel.z);
    return bytes;
}

}  // namespace antipode
