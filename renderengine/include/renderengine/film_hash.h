// The name of a film's sums.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderengine/film.h"
#include "renderengine/sha256.h"

namespace antipode {

/// FilmSums::sha256() of sums that come piece by piece.
class FilmSumsHash {
public:
    /// Of the layout and the numbers of iterations; the values are those that are added.
    explicit FilmSumsHash(const FilmSums& sums);
    /// The next ones, of whatever layers.
    void add(std::span<const int64_t> values);
    /// Lower-case hexadecimal, once. Throws Error(Usage) unless as many values have come as the layout has.
    std::string finish();

private:
    struct Layer {
        int32_t scaleExponent;
        uint64_t iterations, values;
    };
    uint32_t width_, height_;
    std::vector<Layer> layers_;
    size_t layer_ = 0;      ///< that the next value is of
    uint64_t inLayer_ = 0;  ///< values of it that have come
    Sha256 digest_;
};

}  // namespace antipode
