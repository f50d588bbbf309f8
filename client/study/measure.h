// How far an image is from a reference, part by part. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "renderengine/film.h"

namespace antipode::study {

/// A value and what holds it in 95 of 100 cases.
struct Interval {
    double value = 0, low = 0, high = 0;
};

/// The image that errors are measured against.
struct Reference {
    Image image;
    std::vector<float> standardErrors;  ///< per pixel and channel; empty where unknown
};

/// relMSE of each of up to 8×8 tiles of the image, of like size, weighted by its pixels.
struct TileErrors {
    std::vector<double> relMse;  ///< the reference's own noise taken off; may be negative where that is all there is
    std::vector<double> share;   ///< of the image's pixels; they sum to 1
    double referenceRelMse = 0;  ///< what was taken off, of the whole image
    uint64_t nonFinite = 0;      ///< pixels that are left out of their tiles

    double total() const;
};

/// Throws Error(Usage) where sizes differ.
TileErrors measureTiles(const Image& image, const Reference& reference);

/// √relMSE in %, with an interval as if the tiles were drawn from many like them (jackknife over tiles; Efron 1982):
/// wider than that of a repetition, since tiles differ. Zero where no error is left beside the reference's.
Interval percentOf(const TileErrors& errors);
/// The ratio of √relMSE of two images of the same tiles; what they have in common cancels. NaN where either is not
/// above zero.
Interval errorRatio(const TileErrors& errors, const TileErrors& base);

/// Sums of what single iterations took.
struct Durations {
    uint64_t count = 0;
    double sum = 0, squares = 0;

    void add(double seconds);
};

/// The ratio of two mean durations (delta method on logarithms). NaN with fewer than two of either.
Interval durationRatio(const Durations& durations, const Durations& base);

}  // namespace antipode::study
