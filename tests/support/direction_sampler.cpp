#include "support/direction_sampler.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace antipode {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRows = 32, kColumns = 64;
/// Quadrature error allowed per cell and halving, as a probability: 0.02 of one count in 10⁶ samples.
constexpr double kTolerance = 2e-8;
constexpr int kMaxHalvings = 8;

using Density = std::function<double(const Vec3d&)>;

/// A cell of the sphere in z and φ, where dω = dz dφ.
struct Cell {
    double z0, z1, phi0, phi1;
};

/// 3 × 3 Gauss points.
double integrateOnce(const Density& pdf, const Cell& cell) {
    static constexpr double kNode[] = {-0.7745966692414834, 0, 0.7745966692414834};
    static constexpr double kWeight[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    const double hz = (cell.z1 - cell.z0) / 2, hp = (cell.phi1 - cell.phi0) / 2;
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double z = cell.z0 + hz * (1 + kNode[i]), phi = cell.phi0 + hp * (1 + kNode[j]);
            const double r = std::sqrt(1 - z * z);
            sum += kWeight[i] * kWeight[j] * pdf({r * std::cos(phi), r * std::sin(phi), z});
        }
    return sum * hz * hp;
}

/// Quarters the cell until both estimates agree; a jump of the pdf is followed to 1/256 of a cell's width.
double integrateCell(const Density& pdf, const Cell& cell, double coarse, int halvings) {
    const double z = (cell.z0 + cell.z1) / 2, phi = (cell.phi0 + cell.phi1) / 2;
    const Cell quarters[] = {{cell.z0, z, cell.phi0, phi},
                             {z, cell.z1, cell.phi0, phi},
                             {cell.z0, z, phi, cell.phi1},
                             {z, cell.z1, phi, cell.phi1}};
    double parts[4], fine = 0;
    for (int i = 0; i < 4; ++i) fine += parts[i] = integrateOnce(pdf, quarters[i]);
    if (halvings >= kMaxHalvings || (halvings >= 2 && std::abs(fine - coarse) < kTolerance)) return fine;
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += integrateCell(pdf, quarters[i], parts[i], halvings + 1);
    return sum;
}

}  // namespace

DirectionSamplerReport testDirectionSampler(const std::function<std::optional<Vec3d>(Random&)>& sample,
                                            const Density& pdf, uint64_t samples, uint64_t seed) {
    DirectionSamplerReport report;
    std::vector<double> expected(kRows * kColumns + 1), observed(expected.size());
    // Rows are even in θ: cells near the normal, where narrow lobes live, are small.
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const Cell cell{std::cos(kPi * (row + 1) / kRows), std::cos(kPi * row / kRows), 2 * kPi * column / kColumns,
                            2 * kPi * (column + 1) / kColumns};
            const double share = integrateCell(pdf, cell, integrateOnce(pdf, cell), 0);
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
