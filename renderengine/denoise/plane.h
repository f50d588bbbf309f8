// One number a pixel, with a margin around the image so that windows need not look where it ends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace antipode {

/// Row-major; row(y) may be indexed by x from −margin to width + margin − 1, for y in the same bounds.
class Plane {
public:
    /// All of it is `value`.
    Plane(uint32_t width, uint32_t height, int32_t margin = 0, float value = 0)
        : width_(int32_t(width)),
          height_(int32_t(height)),
          margin_(margin),
          stride_(width_ + 2 * margin),
          values_(size_t(stride_) * size_t(height_ + 2 * margin), value) {}

    int32_t width() const { return width_; }
    int32_t height() const { return height_; }
    int32_t margin() const { return margin_; }
    float* row(int32_t y) { return values_.data() + offset(y); }
    const float* row(int32_t y) const { return values_.data() + offset(y); }

    /// Continues the image into the margin, mirrored at its edges.
    void fillMargin() {
        for (int32_t y = -margin_; y < height_ + margin_; ++y)
            for (int32_t x = -margin_; x < width_ + margin_; ++x)
                row(y)[x] = row(mirrored(y, height_))[mirrored(x, width_)];
    }

private:
    /// Reads what is in the image, whatever the order in which the margin is filled.
    static int32_t mirrored(int32_t at, int32_t size) {
        const int32_t inside = at < 0 ? -at - 1 : at >= size ? 2 * size - 1 - at : at;
        return std::clamp(inside, 0, size - 1);
    }
    ptrdiff_t offset(int32_t y) const { return ptrdiff_t(y + margin_) * stride_ + margin_; }

    int32_t width_, height_, margin_, stride_;
    std::vector<float> values_;
};

/// Means over windows of (2·radius + 1)² pixels, as much of them as lies in the image. The margin is as wide, and
/// empty.
Plane smoothed(const Plane& from, int32_t radius);
/// Medians of the same windows.
Plane medians(const Plane& from, int32_t radius);

}  // namespace antipode
