#include "renderengine/denoise.h"

#include <algorithm>
#include <functional>

#include "denoise/halves.h"
#include "denoise/local_regression.h"
#include "denoise/open_image_denoise.h"

namespace antipode {
namespace {

/// Over which squared errors, single ones of which are noise, are averaged.
constexpr int32_t errorRadius = 3;
/// Over which a filter's error is told apart from its neighbours', where something sharp is lost: by more than chance,
/// which is some image errors.
constexpr int32_t sharpRadius = 1;
constexpr float sharpError = 2;
/// How many times the median around it an outlier's variance exceeds.
constexpr float outlier = 8;
/// Of the image's error: what a filter's error is told by has that much noise of its own.
constexpr float leastError = 0.02F;
/// What is no noise, in squares: of a pixel's brightness, and of darkness.
constexpr float noNoise = 1e-8F, least = 1e-30F;

float square(float x) { return x * x; }

Plane planeLike(const Plane& other) { return {uint32_t(other.width()), uint32_t(other.height())}; }

/// The plane of combine(values of a and b).
template <class Combine>
Plane combined(const Plane& a, const Plane& b, const Combine& combine) {
    Plane result = planeLike(a);
    for (int32_t y = 0; y < a.height(); ++y)
        for (int32_t x = 0; x < a.width(); ++x) result.row(y)[x] = combine(a.row(y)[x], b.row(y)[x]);
    return result;
}

/// The image's squared error, summed over channels.
struct ImageError {
    Plane pixel;   ///< by the pixel's own classes
    Plane weight;  ///< in sums of squared errors: 1, and less for outliers, so that each counts as one pixel
    Plane local;   ///< of the pixels around
};

ImageError imageError(const Halves& halves) {
    Plane pixel = planeLike(halves.mean[0]), brightness = pixel;
    for (size_t c = 0; c < 3; ++c) {
        pixel = combined(pixel, halves.variance[c], std::plus());
        brightness = combined(brightness, halves.mean[c], [](float sum, float mean) { return sum + square(mean); });
    }
    const Plane usual = combined(medians(pixel, errorRadius), brightness,
                                 [](float median, float bright) { return median + noNoise * bright + least; });
    const Plane weight =
        combined(pixel, usual, [](float own, float bound) { return std::min(outlier * bound / own, 1.0F); });
    const Plane weighted = combined(pixel, weight, std::multiplies());
    return {pixel, weight, combined(smoothed(weighted, errorRadius), smoothed(weight, errorRadius), std::divides())};
}

/// A filtered image with its expected squared error, summed over channels.
struct Candidate {
    RgbPlanes image;
    Plane error;
};

/// The mean of both halves, filtered alike. Each half's squared distance to the other, unfiltered one exceeds its error
/// by that one's variance; and the mean of both has half of the variance that each has.
Candidate candidateOf(const RgbPlanes& a, const RgbPlanes& b, const Halves& halves, const ImageError& image) {
    const auto& [first, second] = halves.half;
    Plane error = planeLike(a[0]);
    RgbPlanes mean{error, error, error};
    for (size_t c = 0; c < 3; ++c)
        for (int32_t y = 0; y < error.height(); ++y)
            for (int32_t x = 0; x < error.width(); ++x) {
                const float ofA = a[c].row(y)[x], ofB = b[c].row(y)[x], variance = halves.variance[c].row(y)[x];
                const float offA = square(ofA - second.mean[c].row(y)[x]) - variance / second.share;
                const float offB = square(ofB - first.mean[c].row(y)[x]) - variance / first.share;
                error.row(y)[x] += 0.5F * (offA + offB) - 0.25F * square(ofA - ofB);
                mean[c].row(y)[x] = 0.5F * (ofA + ofB);
            }
    // Of the pixels around; and more where something sharp is lost.
    const Plane around = combined(smoothed(combined(error, image.weight, std::multiplies()), errorRadius),
                                  smoothed(image.weight, errorRadius), std::divides());
    const Plane sharp = combined(smoothed(error, sharpRadius), image.local,
                                 [](float own, float noisy) { return own - sharpError * noisy; });
    const Plane told = combined(around, sharp, [](float x, float y) { return std::max(x, y); });
    return {std::move(mean),
            combined(told, image.local, [](float own, float noisy) { return std::max(own, leastError * noisy); })};
}

Vec3f pixelOf(const RgbPlanes& image, int32_t x, int32_t y) {
    return {image[0].row(y)[x], image[1].row(y)[x], image[2].row(y)[x]};
}

/// At a pixel, the mean of the filters by the inverse of their errors, which are much the same error where both blur;
/// and then of that and the image, which err in ways of their own, by the inverse of theirs.
Vec3f weighted(const Halves& halves, const ImageError& image, const std::vector<Candidate>& filters, int32_t x,
               int32_t y) {
    const float imageError = std::max(image.local.row(y)[x], image.pixel.row(y)[x]) + least;
    Vec3f sum;
    float total = 0;
    for (const Candidate& filter : filters) {
        const float weight = 1 / (filter.error.row(y)[x] + least);
        sum += pixelOf(filter.image, x, y) * weight;
        total += weight;
    }
    const float filteredError = float(filters.size()) / total;
    return (sum / total * imageError + pixelOf(halves.mean, x, y) * filteredError) / (imageError + filteredError);
}

}  // namespace

Denoised denoise(const FilmSums& sums, bool openImageDenoise) {
    const Halves halves = halvesOf(sums);
    const Features features = featuresOf(sums);
    const ImageError image = imageError(halves);
    const Filtered a = filtered(halves.half[0], halves.half[1], features);
    const Filtered b = filtered(halves.half[1], halves.half[0], features);
    std::vector<Candidate> filters;
    for (size_t k = 0; k < kernelWidths.size(); ++k) filters.push_back(candidateOf(a[k], b[k], halves, image));
    Denoised result{{sums.layout.width, sums.layout.height, {}}};
    if (const auto library = openImageDenoise ? OpenImageDenoise::find() : std::nullopt) {
        const auto first = library->filtered(halves.half[0], features),
                   second = library->filtered(halves.half[1], features);
        result.openImageDenoise = first && second;
        if (result.openImageDenoise) filters.push_back(candidateOf(*first, *second, halves, image));
    }

    result.image.pixels.reserve(sums.layout.pixels());
    for (int32_t y = 0; y < int32_t(result.image.height); ++y)
        for (int32_t x = 0; x < int32_t(result.image.width); ++x)
            result.image.pixels.push_back(weighted(halves, image, filters, x, y));
    return result;
}

}  // namespace antipode
