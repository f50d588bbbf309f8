#include "client/study/measure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "client/study/fit.h"
#include "renderengine/error.h"
#include "renderengine/error_estimate.h"

namespace antipode::study {
namespace {

constexpr uint32_t tilesPerSide = 8;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// (value of all; standard error) of a function of the image's relMSE, leaving out one tile at a time.
Interval jackknife(size_t tiles, const std::function<double(size_t leftOut)>& value) {
    const double all = value(tiles), n = double(tiles);
    double mean = 0, squares = 0;
    std::vector<double> partial;
    for (size_t i = 0; i < tiles; ++i) partial.push_back(value(i));
    for (const double p : partial) mean += p / n;
    for (const double p : partial) squares += (p - mean) * (p - mean);
    const double half = studentQuantile95(n - 1) * std::sqrt((n - 1) / n * squares);
    return {all, all - half, all + half};
}

double totalWithout(const TileErrors& errors, size_t leftOut) {
    double sum = 0, share = 0;
    for (size_t i = 0; i < errors.relMse.size(); ++i)
        if (i != leftOut) sum += errors.share[i] * errors.relMse[i], share += errors.share[i];
    return sum / share;
}

Interval exponential(const Interval& logarithm) {
    return {std::exp(logarithm.value), std::exp(logarithm.low), std::exp(logarithm.high)};
}

}  // namespace

double TileErrors::total() const { return totalWithout(*this, relMse.size()); }

TileErrors measureTiles(const Image& image, const Reference& reference) {
    if (image.width != reference.image.width || image.height != reference.image.height)
        throw Error(ErrorCode::Usage, "The reference is of " + std::to_string(reference.image.width) + "x" +
                                          std::to_string(reference.image.height) + " pixels, not " +
                                          std::to_string(image.width) + "x" + std::to_string(image.height) + ".");
    const uint32_t across = std::min(tilesPerSide, image.width), down = std::min(tilesPerSide, image.height);
    TileErrors errors;
    errors.relMse.assign(size_t(across) * down, 0);
    errors.share.assign(errors.relMse.size(), 0);
    uint64_t counted = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Vec3f &pixel = image.pixels[i], &known = reference.image.pixels[i];
        if (!isFinite(pixel) || !isFinite(known)) {
            ++errors.nonFinite;
            continue;
        }
        const Vec3d r(known), difference = Vec3d(pixel) - r, weight = Vec3d(1) / (r * r + Vec3d(relativeErrorEpsilon));
        Vec3d noise(0);
        if (!reference.standardErrors.empty())
            noise = {reference.standardErrors[3 * i], reference.standardErrors[3 * i + 1],
                     reference.standardErrors[3 * i + 2]};
        const Vec3d own = noise * noise * weight, error = difference * difference * weight;
        const size_t x = i % image.width, y = i / image.width;
        const size_t tile = y * down / image.height * across + x * across / image.width;
        errors.relMse[tile] += (error.x + error.y + error.z - own.x - own.y - own.z) / 3;
        errors.referenceRelMse += (own.x + own.y + own.z) / 3;
        errors.share[tile] += 1;
        ++counted;
    }
    for (size_t tile = 0; tile < errors.share.size(); ++tile) {
        if (errors.share[tile] > 0) errors.relMse[tile] /= errors.share[tile];
        errors.share[tile] /= double(counted);
    }
    errors.referenceRelMse /= double(counted);
    return errors;
}

Interval percentOf(const TileErrors& errors) {
    const Interval squared = jackknife(errors.relMse.size(), [&](size_t i) { return totalWithout(errors, i); });
    const auto percent = [](double relMse) { return 100 * std::sqrt(std::max(relMse, 0.0)); };
    return {percent(squared.value), percent(squared.low), percent(squared.high)};
}

Interval errorRatio(const TileErrors& errors, const TileErrors& base) {
    bool positive = errors.relMse.size() == base.relMse.size();
    for (size_t i = 0; positive && i <= base.relMse.size(); ++i)
        positive = totalWithout(errors, i) > 0 && totalWithout(base, i) > 0;
    if (!positive) return {nan, nan, nan};
    return exponential(jackknife(
        base.relMse.size(), [&](size_t i) { return 0.5 * std::log(totalWithout(errors, i) / totalWithout(base, i)); }));
}

void Durations::add(double seconds) {
    ++count;
    sum += seconds;
    squares += seconds * seconds;
}

Interval durationRatio(const Durations& durations, const Durations& base) {
    if (durations.count < 2 || base.count < 2) return {nan, nan, nan};
    // Of the mean's logarithm.
    const auto variance = [](const Durations& d) {
        const double n = double(d.count), mean = d.sum / n;
        return std::max(d.squares / n - mean * mean, 0.0) / (n - 1) / (mean * mean);
    };
    const double value = std::log(durations.sum / double(durations.count)) - std::log(base.sum / double(base.count));
    const double half = studentQuantile95(double(std::min(durations.count, base.count)) - 1) *
                        std::sqrt(variance(durations) + variance(base));
    return exponential({value, value - half, value + half});
}

}  // namespace antipode::study
