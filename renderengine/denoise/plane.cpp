#include "denoise/plane.h"

namespace antipode {
namespace {

/// Along one axis: `at` reads, `put` writes, by line and place in it.
template <class At, class Put>
void smoothLines(int32_t lines, int32_t length, int32_t radius, const At& at, const Put& put) {
    for (int32_t line = 0; line < lines; ++line) {
        double sum = 0;
        int32_t count = 0;
        for (int32_t i = -radius; i < length; ++i) {
            if (const int32_t enters = i + radius; enters < length) sum += at(line, enters), ++count;
            if (const int32_t leaves = i - radius - 1; leaves >= 0) sum -= at(line, leaves), --count;
            if (i >= 0) put(line, i, float(sum / count));
        }
    }
}

}  // namespace

Plane smoothed(const Plane& from, int32_t radius) {
    Plane across(uint32_t(from.width()), uint32_t(from.height()), from.margin()), both = across;
    smoothLines(
        from.height(), from.width(), radius, [&](int32_t y, int32_t x) { return from.row(y)[x]; },
        [&](int32_t y, int32_t x, float mean) { across.row(y)[x] = mean; });
    smoothLines(
        from.width(), from.height(), radius, [&](int32_t x, int32_t y) { return across.row(y)[x]; },
        [&](int32_t x, int32_t y, float mean) { both.row(y)[x] = mean; });
    return both;
}

Plane medians(const Plane& from, int32_t radius) {
    Plane result(uint32_t(from.width()), uint32_t(from.height()), from.margin());
    std::vector<float> window;
    for (int32_t y = 0; y < from.height(); ++y)
        for (int32_t x = 0; x < from.width(); ++x) {
            window.clear();
            const int32_t x0 = std::max(x - radius, 0), x1 = std::min(x + radius + 1, from.width());
            for (int32_t v = std::max(y - radius, 0); v < std::min(y + radius + 1, from.height()); ++v)
                window.insert(window.end(), from.row(v) + x0, from.row(v) + x1);
            const auto middle = window.begin() + ptrdiff_t(window.size() / 2);
            std::ranges::nth_element(window, middle);
            result.row(y)[x] = *middle;
        }
    return result;
}

}  // namespace antipode
