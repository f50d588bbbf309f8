#include "techniques/wavelength.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "techniques/sample_sets.h"

namespace antipode {
namespace {

// What an eye sees, in steps of a nanometre.
constexpr int shortest = 380, longest = 780, steps = longest - shortest;
// Fraunhofer's lines F, d and C, in nanometres.
constexpr double lineF = 486.1, lineD = 587.6, lineC = 656.3;

double lobe(double at, double peak, double below, double above) {
    const double t = (at - peak) / (at < peak ? below : above);
    return std::exp(-0.5 * t * t);
}

/// The CIE 1931 colour matching functions by their analytic fit: Wyman, Sloan and Shirley, "Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013, eq. 4.
Vec3d matching(double nm) {
    return {
        1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
        0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
        1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// In linear sRGB (IEC 61966-2-1), without the negative parts, by which a display would have to take away light.
Vec3d seenRgb(double nm) {
    const Vec3d c = matching(nm);
    return {std::max(3.2406 * c.x - 1.5372 * c.y - 0.4986 * c.z, 0.0),
            std::max(-0.9689 * c.x + 1.8758 * c.y + 0.0415 * c.z, 0.0),
            std::max(0.0557 * c.x - 0.2040 * c.y + 1.0570 * c.z, 0.0)};
}

/// The three responses, piecewise linear between whole nanometres and each of integral 1; the density is their mean.
struct Responses {
    std::array<Vec3d, steps + 1> rgb;
    std::array<double, steps + 1> cumulative{};  ///< of the density

    Responses() {
        Vec3d integral;
        for (int i = 0; i <= steps; ++i) {
            rgb[size_t(i)] = seenRgb(shortest + i);
            integral += rgb[size_t(i)] * (i == 0 || i == steps ? 0.5 : 1.0);
        }
        for (Vec3d& v : rgb) v = v / integral;
        for (size_t i = 0; i < steps; ++i) cumulative[i + 1] = cumulative[i] + 0.5 * (density(i) + density(i + 1));
    }

    double density(size_t i) const { return (rgb[i].x + rgb[i].y + rgb[i].z) / 3; }
};

const Responses& responses() {
    static const Responses table;
    return table;
}

}  // namespace

double wavelengthNumber(uint64_t seed, uint64_t iteration) {
    // Sobol's second dimension (Kollig and Keller, "Efficient Multidimensional Sampling", 2002), moved by a digital
    // shift. Its matrix is Pascal's modulo 2, of which any m neighbouring columns of the first m rows have determinant
    // 1. The first dimension, the radical inverse, would give the same wavelengths to every residue class.
    uint32_t bits = randomKeys(seed, std::numeric_limits<uint64_t>::max()).first;
    uint32_t column = 1u << 31;
    for (uint64_t rest = iteration > 0 ? iteration - 1 : 0; rest != 0; rest >>= 1, column ^= column >> 1)
        if ((rest & 1) != 0) bits ^= column;
    return (double(bits) + 0.5) * 0x1p-32;
}

Wavelength wavelengthAt(double number) {
    const Responses& table = responses();
    const double wanted = number * table.cumulative.back();
    const auto above = std::upper_bound(table.cumulative.begin(), table.cumulative.end() - 1, wanted);
    const size_t i = size_t(above - table.cumulative.begin()) - 1;
    // The density is linear within the nanometre, its integral p₀t + (p₁ − p₀)t²/2.
    const double rest = wanted - table.cumulative[i], p0 = table.density(i), p1 = table.density(i + 1);
    const double root = std::sqrt(std::max(p0 * p0 + 2 * (p1 - p0) * rest, 0.0));
    const double t = p0 + root > 0 ? std::clamp(2 * rest / (p0 + root), 0.0, 1.0) : 0.0;
    Wavelength found;
    found.nanometres = shortest + double(i) + t;
    found.response = (table.rgb[i] * (1 - t) + table.rgb[i + 1] * t) / (p0 * (1 - t) + p1 * t);
    const auto inverseSquare = [](double nm) { return 1 / (nm * nm); };
    found.dispersion =
        (inverseSquare(found.nanometres) - inverseSquare(lineD)) / (inverseSquare(lineF) - inverseSquare(lineC));
    return found;
}

Wavelength wavelengthOf(uint64_t seed, uint64_t iteration) { return wavelengthAt(wavelengthNumber(seed, iteration)); }

}  // namespace antipode
