#include "gpu/texel_sums.h"

#include <algorithm>
#include <cmath>

namespace antipode {
namespace {

constexpr int64_t mostBands = 32;
// 2^28 texels of four periods, the most that a sum covers, stay below 2^64.
constexpr double unit = 0x1p32;
// Of a texel: kernels interpolate texture coordinates in float.
constexpr double slack = 1.0 / 64;
// Texture coordinates beyond mean nothing in float, and must fit an integer here.
constexpr double farthest = 0x1p40;

struct Point {
    double x, y;
};
using Triangle = std::array<Point, 3>;

int64_t below(double x) { return int64_t(std::floor(x)); }

/// Moves the triangle by whole periods to where its least coordinate lies in the first one.
void reduce(Triangle& t, double Point::*axis, double period, WrapMode mode) {
    if (mode != WrapMode::Clamp) {
        const double least = std::min({t[0].*axis, t[1].*axis, t[2].*axis});
        const double away = std::floor(least / period) * period;
        for (Point& p : t) p.*axis -= away;
    }
    for (Point& p : t) p.*axis = std::clamp(p.*axis, -farthest, farthest);
}

/// The triangle's extent in x between two heights; empty (first above last) where it lies outside.
Point extentBetween(const Triangle& t, double low, double high) {
    Point extent{INFINITY, -INFINITY};
    const auto add = [&](double x) { extent = {std::min(extent.x, x), std::max(extent.y, x)}; };
    for (size_t k = 0; k < 3; ++k) {
        const Point &a = t[k], &b = t[(k + 1) % 3];
        if (a.y >= low && a.y <= high) add(a.x);
        for (double y : {low, high})
            if ((a.y < y) != (b.y < y)) add(a.x + (b.x - a.x) * std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0));
    }
    return extent;
}

}  // namespace

TexelSums::TexelSums(const Texture& texture, const std::function<double(const uint8_t*)>& value)
    : width_(texture.width),
      height_(texture.height),
      wrapU_(texture.wrapU),
      wrapV_(texture.wrapV),
      table_(size_t(width_ + 1) * size_t(height_ + 1)) {
    const size_t stride = size_t(width_) + 1;
    const uint8_t* texel = texture.rgba.data();
    for (size_t y = 1; y <= size_t(height_); ++y) {
        uint64_t row = 0;
        for (size_t x = 1; x < stride; ++x, texel += 4) {
            row += uint64_t(std::ceil(value(texel) * unit));
            table_[y * stride + x] = table_[(y - 1) * stride + x] + row;
        }
    }
}

std::vector<TexelSums::Range> TexelSums::wrapped(Range range, int64_t size, WrapMode mode) {
    if (mode == WrapMode::Clamp)
        return {{std::clamp<int64_t>(range.first, 0, size - 1), std::clamp<int64_t>(range.last, 0, size - 1)}};
    const int64_t count = range.last - range.first + 1;
    if (count >= size) return {{0, size - 1}};
    const int64_t period = mode == WrapMode::Mirror ? 2 * size : size;
    const int64_t first = ((range.first % period) + period) % period;
    // Pieces of [0, 3·size), in which every second copy of a mirrored texture runs backwards.
    std::vector<Range> pieces;
    for (int64_t at = first; at < first + count;) {
        const int64_t copy = at / size, end = std::min(first + count, (copy + 1) * size);
        const Range piece{at - copy * size, end - 1 - copy * size};
        const bool backwards = mode == WrapMode::Mirror && copy % 2 == 1;
        pieces.push_back(backwards ? Range{size - 1 - piece.last, size - 1 - piece.first} : piece);
        at = end;
    }
    return pieces;
}

uint64_t TexelSums::sum(const Range& columns, const Range& rows) const {
    const auto corner = [&](int64_t x, int64_t y) { return table_[size_t(y) * size_t(width_ + 1) + size_t(x)]; };
    const int64_t right = columns.last + 1, top = rows.last + 1;
    return corner(right, top) - corner(columns.first, top) - corner(right, rows.first) +
           corner(columns.first, rows.first);
}

double TexelSums::mean(const UvTriangle& uv) const {
    Triangle t;  // in texels, whose centres lie at whole numbers
    for (size_t k = 0; k < 3; ++k)
        t[k] = {double(uv[k][0]) * double(width_) - 0.5, double(uv[k][1]) * double(height_) - 0.5};
    reduce(t, &Point::x, double(wrapU_ == WrapMode::Mirror ? 2 * width_ : width_), wrapU_);
    reduce(t, &Point::y, double(wrapV_ == WrapMode::Mirror ? 2 * height_ : height_), wrapV_);
    const int64_t first = below(std::min({t[0].y, t[1].y, t[2].y}) - slack);
    const int64_t rows = below(std::max({t[0].y, t[1].y, t[2].y}) + slack) + 2 - first;
    const int64_t bands = std::min(rows, mostBands);
    uint64_t total = 0, texels = 0;
    for (int64_t band = 0; band < bands; ++band) {
        const Range high{first + rows * band / bands, first + rows * (band + 1) / bands - 1};
        // A look-up takes part of the texels less than one away.
        const Point extent = extentBetween(t, double(high.first - 1) - slack, double(high.last + 1) + slack);
        if (extent.x > extent.y) continue;
        const std::vector<Range> columns =
            wrapped({below(extent.x - slack), below(extent.y + slack) + 1}, width_, wrapU_);
        for (const Range& r : wrapped(high, height_, wrapV_))
            for (const Range& c : columns) {
                total += sum(c, r);
                texels += uint64_t(c.last - c.first + 1) * uint64_t(r.last - r.first + 1);
            }
    }
    return double(total) / unit / double(texels);
}

}  // namespace antipode
