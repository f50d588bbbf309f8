// Merging, normalising and hashing of fixed-point sums.
#include <cmath>

#include "digest/sha256.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

std::string describe(const FilmSums& sums) {
    return std::to_string(sums.width) + "x" + std::to_string(sums.height) + " at scale 2^" +
           std::to_string(sums.scaleExponent) + " with " + std::to_string(sums.rgb.size()) + " sums";
}

size_t sumCount(const FilmSums& sums) { return size_t(sums.width) * sums.height * 3; }

}  // namespace

void FilmSums::merge(const FilmSums& other) {
    if (width != other.width || height != other.height || scaleExponent != other.scaleExponent ||
        rgb.size() != other.rgb.size())
        throw Error(ErrorCode::Usage,
                    "Film sums of " + describe(other) + " cannot be merged into " + describe(*this) + ".");
    for (size_t i = 0; i < rgb.size(); ++i) {
        int64_t sum;
        if (__builtin_add_overflow(rgb[i], other.rgb[i], &sum))
            throw Error(ErrorCode::Usage, "Merging would overflow the 64-bit film sum of pixel " +
                                              std::to_string(i / 3 % width) + "," + std::to_string(i / 3 / width) +
                                              "; render fewer iterations into one image.");
    }
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] += other.rgb[i];
    iterations += other.iterations;
    events += other.events;
}

Image FilmSums::image() const {
    if (iterations == 0) throw Error(ErrorCode::Usage, "A film without iterations has no image.");
    if (rgb.size() != sumCount(*this))
        throw Error(ErrorCode::Usage, "A film of " + describe(*this) + " is inconsistent.");
    Image image{width, height, std::vector<Vec3f>(size_t(width) * height)};
    const auto mean = [&](size_t i) { return float(std::ldexp(double(rgb[i]) / double(iterations), -scaleExponent)); };
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = {mean(3 * i), mean(3 * i + 1), mean(3 * i + 2)};
    return image;
}

std::string FilmSums::sha256() const {
    Sha256 digest;
    digest.addValue(width);
    digest.addValue(height);
    digest.addValue(scaleExponent);
    digest.addValue(iterations);
    digest.addValues(std::span<const int64_t>(rgb));
    return hexadecimal(digest.finish());
}

}  // namespace antipode
