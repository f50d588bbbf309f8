#include "renderengine/exposure.h"

#include <algorithm>
#include <cmath>

namespace antipode {
namespace {

/// Of Rec. 709 primaries.
double luminance(const Vec3f& c) { return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z); }

/// The value below which this share of the values lies; reorders them.
double percentile(std::vector<double>& values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

Image exposed(Image image, double stops) {
    if (stops == 0) return image;
    const double factor = std::exp2(stops);
    for (Vec3f& pixel : image.pixels) pixel = Vec3f(Vec3d(pixel) * factor);
    return image;
}

double autoExposure(const Image& image) {
    std::vector<double> values;
    values.reserve(image.pixels.size());
    for (const Vec3f& pixel : image.pixels)
        if (const double y = luminance(pixel); std::isfinite(y) && y > 0) values.push_back(y);
    if (values.empty()) return 0;
    const double middle = percentile(values, 0.5), high = percentile(values, 0.98);
    if (middle >= 0.02 && middle <= 0.9 && high >= 0.3 && high <= 4) return 0;
    const double stops = (std::log2(0.2 / middle) + std::log2(1 / high)) / 2;
    return std::round(10 * stops) / 10;
}

}  // namespace antipode
