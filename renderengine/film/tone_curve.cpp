#include "film/tone_curve.h"

namespace antipode {

Vec3d toneCurve(const Vec3f& linear) {
    constexpr double shoulderStart = 0.5, shoulderRange = 1.0 - shoulderStart, desaturation = 0.15;

    const Vec3d rgb{std::max(double(linear.x), 0.0), std::max(double(linear.y), 0.0), std::max(double(linear.z), 0.0)};
    const double peak = maxComponent(rgb);
    if (peak <= shoulderStart) return rgb;

    const double shownPeak = 1.0 - shoulderRange * shoulderRange / (peak + shoulderRange - shoulderStart);
    const double whiteness = 1.0 - 1.0 / (desaturation * (peak - shownPeak) + 1.0);
    return rgb * (shownPeak / peak) * (1.0 - whiteness) + Vec3d(shownPeak * whiteness);
}

double encodeSrgb(double displayLinear) {
    return displayLinear <= 0.0031308 ? 12.92 * displayLinear : 1.055 * std::pow(displayLinear, 1.0 / 2.4) - 0.055;
}

uint8_t encodeSrgb8(double displayLinear) { return uint8_t(std::lround(255.0 * encodeSrgb(displayLinear))); }

std::array<uint8_t, 3> displayPixel(const Vec3f& linear) {
    if (!isFinite(linear)) return {255, 0, 255};
    const Vec3d shown = toneCurve(linear);
    return {encodeSrgb8(shown.x), encodeSrgb8(shown.y), encodeSrgb8(shown.z)};
}

std::array<uint16_t, 3> displayPixel16(const Vec3f& linear) {
    if (!isFinite(linear)) return {65535, 0, 65535};
    const Vec3d shown = toneCurve(linear);
    const auto encoded = [](double value) { return uint16_t(std::lround(65535.0 * encodeSrgb(value))); };
    return {encoded(shown.x), encoded(shown.y), encoded(shown.z)};
}

}  // namespace antipode
