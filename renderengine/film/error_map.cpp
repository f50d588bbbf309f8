// Where an image errs, per pixel and in colours.
#include <array>
#include <cmath>
#include <limits>

#include "film/png_bytes.h"
#include "renderengine/error.h"
#include "renderengine/error_estimate.h"
#include "renderengine/pictures.h"

namespace antipode {
namespace {

using Colour = std::array<uint8_t, 3>;

/// At equal steps from 0 to 1, 8-bit sRGB.
constexpr Colour inferno[] = {{0, 0, 4},     {27, 12, 65},   {74, 12, 107}, {120, 28, 109}, {165, 44, 96},
                              {207, 68, 70}, {237, 105, 37}, {251, 155, 6}, {247, 209, 61}, {252, 255, 164}};

/// `t` in [0, 1].
Colour coloured(double t) {
    constexpr size_t last = std::size(inferno) - 1;
    const double position = t * double(last);
    const size_t below = std::min(size_t(position), last - 1);
    Colour colour;
    for (size_t c = 0; c < 3; ++c)
        colour[c] = uint8_t(std::lround(std::lerp(inferno[below][c], inferno[below + 1][c], position - double(below))));
    return colour;
}

}  // namespace

std::vector<float> relativeErrors(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorCode::Usage, "An error map takes images of one size.");
    std::vector<float> errors;
    errors.reserve(a.pixels.size());
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Vec3d reference(b.pixels[i]), difference = Vec3d(a.pixels[i]) - reference;
        const Vec3d relative = difference * difference / (reference * reference + Vec3d(relativeErrorEpsilon));
        const bool known = isFinite(a.pixels[i]) && isFinite(b.pixels[i]);
        errors.push_back(known ? float(std::sqrt((relative.x + relative.y + relative.z) / 3))
                               : std::numeric_limits<float>::quiet_NaN());
    }
    return errors;
}

std::string encodeErrorMap(uint32_t width, uint32_t height, const std::vector<float>& values, double low, double high) {
    if (values.size() != size_t(width) * height) throw Error(ErrorCode::Usage, "An error map takes one value a pixel.");
    std::vector<uint8_t> rgb;
    rgb.reserve(3 * values.size());
    for (const float value : values) {
        const Colour colour = std::isfinite(value)
                                  ? coloured(std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0))
                                  : Colour{255, 0, 255};
        rgb.insert(rgb.end(), colour.begin(), colour.end());
    }
    return pngBytes(width, height, rgb);
}

}  // namespace antipode
