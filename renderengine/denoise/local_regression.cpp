#include "denoise/local_regression.h"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <tbb/parallel_for.h>

namespace antipode {
namespace {

constexpr int32_t tileSide = 32;
constexpr size_t terms = featureCount + 1;               // and the constant
constexpr size_t gramEntries = terms * (terms + 1) / 2;  // of a symmetric matrix, row by row from the diagonal on
// Added to the diagonal, as a share of all weight: below a standard deviation of its root a feature explains little.
constexpr float ridge = 1e-3F;
constexpr float leastVariance = 1e-10F;

using Row = std::array<float, tileSide>;

/// A rectangle of pixels, at most tileSide in each direction.
struct Tile {
    int32_t x, y, width, height;
};

/// Normal equations of a row of pixels, side by side so that they are summed together.
struct NormalEquations {
    std::array<Row, gramEntries> gram{};
    std::array<std::array<Row, terms>, 3> right{};
};

/// Squared distances of pixels to those at an offset, noise taken out and in units of noise: what a kernel of width 1
/// has as its exponent. Positive parts, means over patches and channels.
class PatchDistances {
public:
    PatchDistances(const Half& half, const Tile& tile) : half_(half), tile_(tile) {}

    void compute(int32_t dx, int32_t dy) {
        constexpr int32_t reach = patchRadius;
        const int32_t width = tile_.width + 2 * reach, height = tile_.height + 2 * reach;
        // Columns of patches first, then rows of those.
        for (int32_t j = 0; j < height; ++j) {
            const int32_t y = tile_.y + j - reach;
            Wide& line = lines_[size_t(j)];
            line.fill(0);
            for (size_t c = 0; c < 3; ++c) {
                const float* u = half_.mean[c].row(y) + tile_.x - reach;
                const float* v = half_.variance[c].row(y) + tile_.x - reach;
                const float* uq = half_.mean[c].row(y + dy) + tile_.x - reach + dx;
                const float* vq = half_.variance[c].row(y + dy) + tile_.x - reach + dx;
                for (int32_t i = 0; i < width; ++i) {
                    const float difference = u[i] - uq[i];
                    line[size_t(i)] +=
                        (difference * difference - (v[i] + std::min(v[i], vq[i]))) / (leastVariance + v[i] + vq[i]);
                }
            }
        }
        constexpr float share = 1.0F / (3 * (2 * reach + 1) * (2 * reach + 1));
        for (int32_t j = 0; j < tile_.height; ++j) {
            Wide column{};
            for (int32_t k = 0; k <= 2 * reach; ++k)
                for (int32_t i = 0; i < width; ++i) column[size_t(i)] += lines_[size_t(j) + size_t(k)][size_t(i)];
            Row& out = rows_[size_t(j)];
            out.fill(0);
            for (int32_t k = 0; k <= 2 * reach; ++k)
                for (int32_t i = 0; i < tile_.width; ++i) out[size_t(i)] += column[size_t(i) + size_t(k)];
            for (float& value : out) value = std::max(value * share, 0.0F);
        }
    }
    const Row& row(int32_t j) const { return rows_[size_t(j)]; }

private:
    using Wide = std::array<float, tileSide + 2 * patchRadius>;
    const Half& half_;
    Tile tile_;
    std::array<Wide, tileSide + 2 * patchRadius> lines_{};
    std::array<Row, tileSide> rows_{};
};

/// Adds the pixels at an offset, each with its weight, to a row's equations.
void accumulate(std::array<NormalEquations, kernelWidths.size()>& equations,
                const std::array<Row, kernelWidths.size()>& weights, const std::array<Row, terms>& terms_,
                const std::array<Row, 3>& radiance) {
    size_t entry = 0;
    for (size_t a = 0; a < terms; ++a)
        for (size_t b = a; b < terms; ++b, ++entry)
            for (size_t i = 0; i < size_t(tileSide); ++i) {
                const float product = terms_[a][i] * terms_[b][i];
                for (size_t k = 0; k < kernelWidths.size(); ++k) equations[k].gram[entry][i] += weights[k][i] * product;
            }
    for (size_t c = 0; c < 3; ++c)
        for (size_t a = 0; a < terms; ++a)
            for (size_t i = 0; i < size_t(tileSide); ++i) {
                const float product = terms_[a][i] * radiance[c][i];
                for (size_t k = 0; k < kernelWidths.size(); ++k) equations[k].right[c][a][i] += weights[k][i] * product;
            }
}

/// The fit's value at pixel i of the row, where all features are 0. Radiance is not negative, though a line may be.
std::array<float, 3> solve(const NormalEquations& equations, size_t i) {
    using Matrix = Eigen::Matrix<float, int(terms), int(terms)>;
    Matrix gram;
    size_t entry = 0;
    for (int a = 0; a < int(terms); ++a)
        for (int b = a; b < int(terms); ++b, ++entry) gram(a, b) = gram(b, a) = equations.gram[entry][i];
    const float weight = gram(0, 0);
    for (int a = 1; a < int(terms); ++a) gram(a, a) += ridge * weight;
    Eigen::Matrix<float, int(terms), 3> right;
    for (int c = 0; c < 3; ++c)
        for (int a = 0; a < int(terms); ++a) right(a, c) = equations.right[size_t(c)][size_t(a)][i];
    const Eigen::Matrix<float, int(terms), 3> fit = gram.llt().solve(right);
    return {std::max(fit(0, 0), 0.0F), std::max(fit(0, 1), 0.0F), std::max(fit(0, 2), 0.0F)};
}

/// Whether a window's row or column is in the image; what is beyond has no weight.
bool inside(int32_t at, int32_t size) { return at >= 0 && at < size; }

void filterTile(Filtered& out, const Half& half, const Half& other, const Features& features, const Tile& tile) {
    std::vector<std::array<NormalEquations, kernelWidths.size()>> equations(size_t(tile.height));
    PatchDistances distances(other, tile);
    const int32_t width = features[0].width(), height = features[0].height();
    for (int32_t dy = -windowRadius; dy <= windowRadius; ++dy) {
        for (int32_t dx = -windowRadius; dx <= windowRadius; ++dx) {
            distances.compute(dx, dy);
            for (int32_t j = 0; j < tile.height; ++j) {
                const int32_t y = tile.y + j;
                if (!inside(y + dy, height)) continue;
                std::array<Row, kernelWidths.size()> weights{};
                for (int32_t i = 0; i < tile.width; ++i)
                    for (size_t k = 0; k < kernelWidths.size(); ++k)
                        if (inside(tile.x + i + dx, width))
                            weights[k][size_t(i)] =
                                std::exp(-distances.row(j)[size_t(i)] / (kernelWidths[k] * kernelWidths[k]));
                std::array<Row, terms> terms_{};
                std::array<Row, 3> radiance{};
                terms_[0].fill(1);
                for (size_t f = 0; f < featureCount; ++f)
                    for (int32_t i = 0; i < tile.width; ++i)
                        terms_[f + 1][size_t(i)] =
                            features[f].row(y + dy)[tile.x + i + dx] - features[f].row(y)[tile.x + i];
                for (size_t c = 0; c < 3; ++c)
                    for (int32_t i = 0; i < tile.width; ++i)
                        radiance[c][size_t(i)] = half.mean[c].row(y + dy)[tile.x + i + dx];
                accumulate(equations[size_t(j)], weights, terms_, radiance);
            }
        }
    }
    for (size_t k = 0; k < kernelWidths.size(); ++k)
        for (int32_t j = 0; j < tile.height; ++j)
            for (int32_t i = 0; i < tile.width; ++i) {
                const std::array<float, 3> value = solve(equations[size_t(j)][k], size_t(i));
                for (size_t c = 0; c < 3; ++c) out[k][c].row(tile.y + j)[tile.x + i] = value[c];
            }
}

}  // namespace

Filtered filtered(const Half& half, const Half& other, const Features& features) {
    const int32_t width = features[0].width(), height = features[0].height();
    const Plane plane{uint32_t(width), uint32_t(height)};
    const RgbPlanes planes{plane, plane, plane};
    Filtered out{planes, planes};
    const int32_t across = (width + tileSide - 1) / tileSide, down = (height + tileSide - 1) / tileSide;
    tbb::parallel_for(0, across * down, [&](int32_t index) {
        const int32_t x = index % across * tileSide, y = index / across * tileSide;
        filterTile(out, half, other, features, {x, y, std::min(tileSide, width - x), std::min(tileSide, height - y)});
    });
    return out;
}

}  // namespace antipode
