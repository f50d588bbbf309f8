#include "film/tile_spread.h"

#include <algorithm>
#include <numeric>

namespace antipode {
namespace {

constexpr double normalQuantile = 1.959963984540054;  // of 97.5 %

/// Sums up what tiles tell; an estimate of f degrees of freedom has E[s⁴] = σ⁴·(1 + 2/f).
class Spreads {
public:
    explicit Spreads(double degreesOfATile) : perTile_(degreesOfATile) {}

    void add(double variance) { sum_ += variance, squares_ += variance * variance; }
    Spread spread() const {
        return {sum_, squares_ > 0 ? std::max(sum_ * sum_ * (perTile_ + 2) / squares_, 2.0) : 2.0};
    }

private:
    double perTile_, sum_ = 0, squares_ = 0;
};

/// The tiles in blocks of 2×2.
Tiles inFours(const Tiles& tiles) {
    Tiles fours(tiles.size() / 4);
    for (uint32_t i = 0; i < tiles.size(); ++i) {
        Tile& four = fours[i / tilesPerSide / 2 * (tilesPerSide / 2) + i % tilesPerSide / 2];
        for (size_t j = 0; j < four.size(); ++j) four[j] += tiles[i][j];
    }
    return fours;
}

}  // namespace

uint32_t tileOf(const FilmLayout& layout, uint64_t pixel) {
    const uint64_t x = pixel % layout.width, y = pixel / layout.width;
    return uint32_t(y * tilesPerSide / layout.height * tilesPerSide + x * tilesPerSide / layout.width);
}

Spread spreadOf(const Tiles& tiles, uint32_t contrasts) {
    Spreads spreads(std::max(contrasts - 1, 1u));
    for (const Tile& tile : tiles) {
        const double mean = std::accumulate(tile.begin(), tile.begin() + contrasts, 0.0) / contrasts;
        double variance = 0;
        for (uint32_t j = 0; j < contrasts; ++j) variance += (tile[j] - mean) * (tile[j] - mean);
        // One contrast alone: E[t²] = 3·E[t]² where the whole tile errs alike, and 2/3 of it is variance.
        spreads.add(contrasts > 1 ? variance / (contrasts - 1) : mean * mean * 2 / 3);
    }
    return spreads.spread();
}

Spread spreadAboutZero(const Tiles& tiles, uint32_t contrasts) {
    Spreads spreads(contrasts);
    for (const Tile& tile : tiles) {
        double variance = 0;
        for (uint32_t j = 0; j < contrasts; ++j) variance += tile[j] * tile[j] / contrasts;
        spreads.add(variance);
    }
    return spreads.spread();
}

Spread withoutBorders(Spread (*spread)(const Tiles&, uint32_t), const Tiles& tiles, uint32_t contrasts) {
    const Spread fine = spread(tiles, contrasts), coarse = spread(inFours(tiles), contrasts);
    if (contrasts == 1 || coarse.variance <= fine.variance) return fine;
    return {2 * coarse.variance - fine.variance, coarse.degreesOfFreedom};
}

double studentQuantile(double degreesOfFreedom) {
    const double z = normalQuantile, n = degreesOfFreedom;
    const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

}  // namespace antipode
