// Image against reference: means, errors and the pixels that make them.
#include <algorithm>

#include "renderengine/error.h"
#include "renderengine/error_estimate.h"
#include "renderengine/film.h"

namespace antipode {
namespace {

constexpr size_t worstCount = 10;

bool hasNegative(const Vec3f& v) { return v.x < 0 || v.y < 0 || v.z < 0; }

/// Row-major order breaks ties, so that the list is the same on every run.
bool isWorse(const WorstPixel& p, const WorstPixel& q) {
    if (p.relativeSquaredError != q.relativeSquaredError) return p.relativeSquaredError > q.relativeSquaredError;
    return p.y != q.y ? p.y < q.y : p.x < q.x;
}

/// Keeps `worst` the up to ten worst pixels seen, worst first.
void insertWorst(std::vector<WorstPixel>& worst, const WorstPixel& pixel) {
    if (pixel.relativeSquaredError == 0 || (worst.size() == worstCount && !isWorse(pixel, worst.back()))) return;
    worst.insert(std::upper_bound(worst.begin(), worst.end(), pixel, isWorse), pixel);
    if (worst.size() > worstCount) worst.pop_back();
}

}  // namespace

ImageComparison compareImages(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorCode::Usage, "Images of different sizes cannot be compared: " + std::to_string(a.width) + "x" +
                                          std::to_string(a.height) + " and " + std::to_string(b.width) + "x" +
                                          std::to_string(b.height) + ".");
    ImageComparison result;
    double squaredError = 0, relativeSquaredError = 0;
    uint64_t comparedPixels = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Vec3f &pixelA = a.pixels[i], &pixelB = b.pixels[i];
        result.nonFiniteA += !isFinite(pixelA);
        result.nonFiniteB += !isFinite(pixelB);
        result.negativeA += hasNegative(pixelA);
        result.negativeB += hasNegative(pixelB);
        if (!isFinite(pixelA) || !isFinite(pixelB)) continue;

        const Vec3d valueA(pixelA), valueB(pixelB), squared = (valueA - valueB) * (valueA - valueB);
        const Vec3d relative = squared / (valueB * valueB + Vec3d(relativeErrorEpsilon));
        const double pixelError = (relative.x + relative.y + relative.z) / 3;
        result.meanA += valueA;
        result.meanB += valueB;
        squaredError += squared.x + squared.y + squared.z;
        relativeSquaredError += pixelError;
        ++comparedPixels;
        insertWorst(result.worst, {uint32_t(i % a.width), uint32_t(i / a.width), pixelA, pixelB, pixelError});
    }
    // Without a finite pixel the means are 0/0: NaN, which says so better than any number would.
    const double count = double(comparedPixels);
    result.meanA = result.meanA / count;
    result.meanB = result.meanB / count;
    result.ratio = result.meanA / result.meanB;
    result.rmse = std::sqrt(squaredError / (3 * count));
    result.relMse = relativeSquaredError / count;
    return result;
}

}  // namespace antipode
