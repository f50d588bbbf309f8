#include "support/direction_sampler.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace antipode {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRows = 32, kColumns = 64, kSplit = 4;

/// ∫ pdf dω over z in [z0, z1], φ in [phi0, phi1], where dω = dz dφ.
double integrateCell(const std::function<double(const Vec3d&)>& pdf, double z0, double z1, double phi0, double phi1) {
    static constexpr double kNode[] = {-0.7745966692414834, 0, 0.7745966692414834};
    static constexpr double kWeight[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    const double hz = (z1 - z0) / (2 * kSplit), hp = (phi1 - phi0) / (2 * kSplit);
    double sum = 0;
    for (int i = 0; i < kSplit * 3; ++i)
        for (int j = 0; j < kSplit * 3; ++j) {
            const double z = z0 + hz * (2 * (i / 3) + 1 + kNode[i % 3]);
            const double phi = phi0 + hp * (2 * (j / 3) + 1 + kNode[j % 3]), r = std::sqrt(1 - z * z);
            sum += kWeight[i % 3] * kWeight[j % 3] * pdf({r * std::cos(phi), r * std::sin(phi), z});
        }
    return sum * hz * hp;
}

}  // namespace

DirectionSamplerReport testDirectionSampler(const std::function<std::optional<Vec3d>(Random&)>& sample,
                                            const std::function<double(const Vec3d&)>& pdf, uint64_t samples,
                                            uint64_t seed) {
    DirectionSamplerReport report;
    std::vector<double> expected(kRows * kColumns + 1), observed(expected.size());
    // Rows are even in θ: cells near the normal, where narrow lobes live, are small.
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const double share = integrateCell(pdf, std::cos(kPi * (row + 1) / kRows), std::cos(kPi * row / kRows),
                                               2 * kPi * column / kColumns, 2 * kPi * (column + 1) / kColumns);
            expected[row * kColumns + column] = share * double(samples);
            report.integral += share;
        }
    const auto position = [](double fraction, int count) { return std::clamp(int(fraction * count), 0, count - 1); };

    Random random(seed);
    uint64_t empty = 0;
    for (uint64_t i = 0; i < samples; ++i) {
        const auto w = sample(random);
        if (!w) {
            ++empty;
            continue;
        }
        const double density = pdf(*w);
        report.zeroPdf += !(density > 0 && std::isfinite(density));
        const double theta = std::acos(std::clamp(w->z, -1.0, 1.0)), phi = std::atan2(w->y, w->x);
        ++observed[position(theta / kPi, kRows) * kColumns + position(phi / (2 * kPi) + (phi < 0), kColumns)];
    }
    report.emptyShare = double(empty) / double(samples);
    // Quadrature can leave the integral a hair above one.
    expected.back() = std::max(0.0, 1 - report.integral) * double(samples);
    observed.back() = double(empty);
    report.chiSquare = chiSquareTest(observed, expected);
    return report;
}

}  // namespace antipode
