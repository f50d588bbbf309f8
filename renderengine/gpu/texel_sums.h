// Sums of one value a texel over what a triangle of texture coordinates touches, in a time that no texture lengthens.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

using UvTriangle = std::array<std::array<float, 2>, 3>;

/// A summed-area table (Crow, "Summed-Area Tables for Texture Mapping", SIGGRAPH 1984) in whole numbers, so that what
/// is black sums to 0 exactly. Built in time and 8 bytes a texel; the texture must outlive nothing.
class TexelSums {
public:
    /// `value` of a texel's four bytes, in [0,1]; kept to 2^-32, rounded up, so that only 0 is 0.
    TexelSums(const Texture& texture, const std::function<double(const uint8_t*)>& value);

    /// Mean of the values over all texels that bilinear look-ups inside the triangle take part of, wrapped as the
    /// texture wraps. The triangle is taken in at most 32 bands, each as wide as its widest row, and what covers a
    /// whole period as one period. 0 only where all of these texels are 0.
    double mean(const UvTriangle& uv) const;

private:
    struct Range {
        int64_t first, last;  ///< both included
    };
    static std::vector<Range> wrapped(Range range, int64_t size, WrapMode mode);
    uint64_t sum(const Range& columns, const Range& rows) const;

    int64_t width_, height_;
    WrapMode wrapU_, wrapV_;
    std::vector<uint64_t> table_;  ///< (width + 1)·(height + 1): over all texels left of and below the corner
};

}  // namespace antipode
