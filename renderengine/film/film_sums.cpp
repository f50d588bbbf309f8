// Merging, normalising and hashing of fixed-point sums.
#include <cmath>

#include "renderengine/sha256.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

std::string describe(const FilmSums& sums) {
    std::string text = std::to_string(sums.layout.width) + "x" + std::to_string(sums.layout.height);
    for (const FilmLayer& layer : sums.layout.layers)
        text += (layer.name.empty() ? "" : ", " + layer.name) + " at scale 2^" + std::to_string(layer.scaleExponent);
    return text + " with " + std::to_string(sums.values.size()) + " sums";
}

/// "pixel 3,4", and of which layer where it is not the image.
std::string describe(const FilmLayout& layout, size_t value) {
    size_t index = 0;
    while (index + 1 < layout.layers.size() && layout.offset(index + 1) <= value) ++index;
    const FilmLayer& layer = layout.layers[index];
    const size_t pixel = (value - layout.offset(index)) / layer.channels.size();
    return "pixel " + std::to_string(pixel % layout.width) + "," + std::to_string(pixel / layout.width) +
           (layer.name.empty() ? "" : " of layer '" + layer.name + "'");
}

void requireConsistent(const FilmSums& sums) {
    if (sums.values.size() != sums.layout.values())
        throw Error(ErrorCode::Usage, "A film of " + describe(sums) + " is inconsistent.");
}

}  // namespace

std::span<int64_t> FilmSums::layer(size_t index) {
    return std::span(values).subspan(layout.offset(index), layout.offset(index + 1) - layout.offset(index));
}

std::span<const int64_t> FilmSums::layer(size_t index) const {
    return std::span(values).subspan(layout.offset(index), layout.offset(index + 1) - layout.offset(index));
}

void FilmSums::merge(const FilmSums& other) {
    if (layout != other.layout || values.size() != other.values.size())
        throw Error(ErrorCode::Usage,
                    "Film sums of " + describe(other) + " cannot be merged into " + describe(*this) + ".");
    for (size_t i = 0; i < values.size(); ++i) {
        int64_t sum;
        if (__builtin_add_overflow(values[i], other.values[i], &sum))
            throw Error(ErrorCode::Device, "the 64-bit sum of " + describe(layout, i) +
                                               " would overflow; render fewer iterations into one image.");
    }
    for (size_t i = 0; i < values.size(); ++i) values[i] += other.values[i];
    iterations += other.iterations;
    events += other.events;
}

Image FilmSums::image() const {
    if (iterations == 0) throw Error(ErrorCode::Usage, "A film without iterations has no image.");
    requireConsistent(*this);
    Image image{layout.width, layout.height, std::vector<Vec3f>(layout.pixels())};
    const std::span<const int64_t> sums = layer(0);
    const int32_t exponent = layout.layers[0].scaleExponent;
    const auto mean = [&](size_t i) { return float(std::ldexp(double(sums[i]) / double(iterations), -exponent)); };
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = {mean(3 * i), mean(3 * i + 1), mean(3 * i + 2)};
    return image;
}

std::string FilmSums::sha256() const {
    requireConsistent(*this);
    Sha256 digest;
    for (size_t i = 0; i < layout.layers.size(); ++i) {
        digest.addValue(layout.width);
        digest.addValue(layout.height);
        digest.addValue(layout.layers[i].scaleExponent);
        digest.addValue(iterations);
        digest.addValues(layer(i));
    }
    return hexadecimal(digest.finish());
}

}  // namespace antipode
