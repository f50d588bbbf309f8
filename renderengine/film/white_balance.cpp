#include <algorithm>
#include <array>

#include "renderengine/exposure.h"

namespace antipode {
namespace {

using Matrix = std::array<Vec3d, 3>;  // rows

Vec3d times(const Matrix& m, const Vec3d& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

// Rec. 709 primaries with white D65 (IEC 61966-2-1).
constexpr Matrix toXyz{
    {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};
constexpr Matrix fromXyz{
    {{3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}}};
// Sharpened cone responses (Lam 1985, "Bradford").
constexpr Matrix toCones{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
constexpr Matrix fromCones{
    {{0.9869929, -0.1470543, 0.1599627}, {0.4323053, 0.5183603, 0.0492912}, {-0.0085287, 0.0400428, 0.9684867}}};

struct Chromaticity {
    double x, y;
};

/// The Planckian locus by the cubics of Kim et al. (2002, US patent 7024034), from 1667 K to 25,000 K.
Chromaticity planckian(double t) {
    const double a = 1e3 / t;
    const double x = t < 4000 ? ((-0.2661239 * a - 0.2343589) * a + 0.8776956) * a + 0.179910
                              : ((-3.0258469 * a + 2.1070379) * a + 0.2226347) * a + 0.240390;
    const double y = t < 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                     : t < 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    return {x, y};
}

/// CIE daylight (CIE 15:2004), from 4000 K to 25,000 K.
Chromaticity daylight(double t) {
    const double a = 1e3 / t;
    const double x = t < 7000 ? ((-4.6070 * a + 2.9678) * a + 0.09911) * a + 0.244063
                              : ((-2.0064 * a + 1.9018) * a + 0.24748) * a + 0.237040;
    return {x, (-3.000 * x + 2.870) * x - 0.275};
}

/// Of a light that people call by this temperature: lamps glow as black bodies do, daylight is greener; in between some
/// of both, so that nothing jumps.
Vec3d whiteXyz(double kelvin) {
    const double share = std::clamp((kelvin - 4000) / 1000, 0.0, 1.0);
    const Chromaticity glow = planckian(kelvin), day = daylight(std::max(kelvin, 4000.0));
    const double x = glow.x + share * (day.x - glow.x), y = glow.y + share * (day.y - glow.y);
    return {x / y, 1, (1 - x - y) / y};
}

}  // namespace

Image whiteBalanced(Image image, double kelvin) {
    const Vec3d from = times(toCones, whiteXyz(kelvin)), to = times(toCones, whiteXyz(daylightKelvin));
    const Vec3d gain = to / from;
    for (Vec3f& pixel : image.pixels)
        pixel = Vec3f(times(fromXyz, times(fromCones, times(toCones, times(toXyz, Vec3d(pixel))) * gain)));
    return image;
}

}  // namespace antipode
