// How far a sum over pixels may be off, from what its repetitions differ by within each of 8×8 tiles of the image: that
// sees what neighbours share within a tile.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "film/class_contrasts.h"

namespace antipode {

inline constexpr uint32_t tilesPerSide = 8;             // a multiple of 2
using Tile = std::array<double, ClassContrasts::most>;  ///< of each contrast, the tile's part of the sum
using Tiles = std::vector<Tile>;

inline Tiles emptyTiles() { return Tiles(tilesPerSide * tilesPerSide); }
/// The tile of a pixel.
uint32_t tileOf(const FilmLayout& layout, uint64_t pixel);

struct Spread {
    double variance = 0, degreesOfFreedom = 1;
};

/// Of the sum that one contrast tells, by what contrasts differ by. Tiles are independent; within a tile its contrasts
/// are repetitions.
Spread spreadOf(const Tiles& tiles, uint32_t contrasts);
/// The same of sums whose expectation is known to be 0.
Spread spreadAboutZero(const Tiles& tiles, uint32_t contrasts);

/// One of the two where what neighbours share across the borders of tiles counts, too: it takes from the variance in
/// proportion to the borders' length, which halves from tiles to blocks of 2×2.
Spread withoutBorders(Spread (*spread)(const Tiles&, uint32_t), const Tiles& tiles, uint32_t contrasts);

/// Student's quantile of 97.5 % (Cornish-Fisher expansion: Abramowitz & Stegun 1964, 26.7.5).
double studentQuantile(double degreesOfFreedom);

}  // namespace antipode
