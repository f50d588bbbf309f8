#include "gpu/sheen_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antipode {
namespace {

/// The exponent of Λ for cosines below one half (Estevez and Kulla 2017, section 3).
double maskingFit(double cosine, double alpha) {
    const double s = (1 - alpha) * (1 - alpha);
    return std::lerp(21.5473, 25.3245, s) /
               (1 + std::lerp(3.82987, 3.32435, s) * std::pow(cosine, std::lerp(0.19823, 0.16801, s))) +
           std::lerp(-1.9776, -1.27393, s) * cosine + std::lerp(-4.32054, -4.85967, s);
}

/// Where light grazes closer than the fit was made for, Λ times the cosine vanishes, and fibres would give more than
/// they get.
constexpr double leastCosine = 1e-4;

double lambda(double cosine, double alpha) {
    return cosine < 0.5 ? std::exp(maskingFit(cosine, alpha))
                        : std::exp(2 * maskingFit(0.5, alpha) - maskingFit(1 - cosine, alpha));
}

}  // namespace

double sheenAlbedo(double cosine, double alpha) {
    constexpr int heights = 128, azimuths = 64;
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0)), seen = std::max(cosine, leastCosine),
                 known = 1 + lambda(seen, alpha);
    double sum = 0;
    for (int i = 0; i < heights; ++i) {
        // Even steps in the root of the other direction's cosine.
        const double root = (i + 0.5) / heights, other = root * root, otherSine = std::sqrt(1 - other * other);
        double ring = 0;
        for (int j = 0; j < azimuths; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / azimuths;
            const double across2 = sine * sine + otherSine * otherSine + 2 * sine * otherSine * std::cos(phi),
                         up = cosine + other;
            ring += std::pow(across2 / (across2 + up * up), 0.5 / alpha);
        }
        const double lit = std::max(other, leastCosine);
        sum += 2 * root * ring / azimuths * (other / lit) / (known + lambda(lit, alpha));
    }
    return (2 + 1 / alpha) * sum / heights / (4 * seen);
}

}  // namespace antipode
