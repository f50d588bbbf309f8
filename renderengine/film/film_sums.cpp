// Merging, normalising and hashing of fixed-point sums.
#include <algorithm>
#include <cmath>
#include <limits>

#include "renderengine/sha256.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "renderengine/film_hash.h"
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

[[noreturn]] void failToAdd(const FilmLayout& layout, size_t value) {
    throw Error(ErrorCode::Device, "the 64-bit sum of " + describe(layout, value) +
                                       " would overflow; render fewer iterations into one image.");
}

__extension__ typedef __int128 Wide;  ///< holds any sum of 64-bit sums

/// The layers of a kind, which lie one behind the other.
struct Classes {
    size_t first, count, stride;  ///< in sums

    Classes(const FilmLayout& layout, LayerKind kind)
        : first(layout.offset(layout.find(kind))),
          count(layout.count(kind)),
          stride(layout.offset(layout.find(kind) + 1) - first) {}
};

/// The sum over all of them, where it fits: `value` of the first, of which `sumOf` gives any sum.
template <class SumOf>
int64_t sumOver(const Classes& classes, const FilmLayout& layout, size_t value, const SumOf& sumOf) {
    Wide sum = 0;
    for (size_t k = 0; k < classes.count; ++k) sum += sumOf(classes.first + k * classes.stride + value);
    if (sum != int64_t(sum)) failToAdd(layout, classes.first + value);
    return int64_t(sum);
}

}  // namespace

std::span<int64_t> FilmSums::layer(size_t index) {
    return std::span(values).subspan(layout.offset(index), layout.offset(index + 1) - layout.offset(index));
}

std::span<const int64_t> FilmSums::layer(size_t index) const {
    return std::span(values).subspan(layout.offset(index), layout.offset(index + 1) - layout.offset(index));
}

uint64_t FilmSums::iterationsOf(size_t layer) const {
    const LayerKind kind = layout.layers.at(layer).kind;
    return layout.count(kind) > 1 ? residueIterations.at(layer - layout.find(kind)) : iterations;
}

std::vector<int64_t> FilmSums::summed(LayerKind kind) const {
    requireConsistent(*this);
    const Classes classes(layout, kind);
    std::vector<int64_t> sums(classes.stride);
    for (size_t i = 0; i < sums.size(); ++i)
        sums[i] = sumOver(classes, layout, i, [&](size_t at) { return values[at]; });
    return sums;
}

void FilmSums::merge(const FilmSums& other) {
    if (layout != other.layout || values.size() != other.values.size() ||
        residueIterations.size() != other.residueIterations.size())
        throw Error(ErrorCode::Usage,
                    "Film sums of " + describe(other) + " cannot be merged into " + describe(*this) + ".");
    for (size_t i = 0; i < values.size(); ++i) {
        int64_t sum;
        if (__builtin_add_overflow(values[i], other.values[i], &sum)) failToAdd(layout, i);
    }
    if (!residueIterations.empty()) {
        const Classes image(layout, LayerKind::Image);
        for (size_t i = 0; i < image.stride; ++i)
            sumOver(image, layout, i, [&](size_t at) { return Wide(values[at]) + other.values[at]; });
    }
    for (size_t i = 0; i < values.size(); ++i) values[i] += other.values[i];
    for (size_t k = 0; k < residueIterations.size(); ++k) residueIterations[k] += other.residueIterations[k];
    iterations += other.iterations;
    events += other.events;
}

void FilmSums::merge(const FilmSums& other, uint32_t residueClass) {
    const uint32_t classes = layout.residueClasses();
    if (classes < 2 || residueClass >= classes || other.layout.residueClasses() != 1 ||
        layout != inClasses(other.layout, classes) || other.values.size() != other.layout.values() ||
        residueIterations.size() != classes)
        throw Error(ErrorCode::Usage, "Film sums of " + describe(other) + " cannot be merged into class " +
                                          std::to_string(residueClass) + " of " + describe(*this) + ".");
    const std::vector<size_t> places = placesInClasses(other.layout, classes, residueClass);
    const auto forEachSum = [&](const auto& use) {
        for (size_t l = 0; l < places.size(); ++l) {
            const std::span<const int64_t> added = other.layer(l);
            const size_t place = layout.offset(places[l]);
            for (size_t i = 0; i < added.size(); ++i) use(place + i, added[i]);
        }
    };
    forEachSum([&](size_t at, int64_t added) {
        int64_t sum;
        if (__builtin_add_overflow(values[at], added, &sum)) failToAdd(layout, at);
    });
    const Classes image(layout, LayerKind::Image);
    for (size_t i = 0; i < image.stride; ++i)
        sumOver(image, layout, i, [&](size_t at) {
            return Wide(values[at]) + (at == image.stride * residueClass + i ? other.values[i] : 0);
        });
    forEachSum([&](size_t at, int64_t added) { values[at] += added; });
    residueIterations[residueClass] += other.iterations;
    iterations += other.iterations;
    events += other.events;
}

FilmSums FilmSums::imageAlone() const {
    FilmSums alone;
    alone.layout = {layout.width, layout.height, {layout.layers.at(0)}};
    alone.layout.layers[0].name.clear();
    alone.iterations = iterations;
    alone.events = events;
    alone.values = summed(LayerKind::Image);
    return alone;
}

Image FilmSums::image() const {
    if (iterations == 0) throw Error(ErrorCode::Usage, "A film without iterations has no image.");
    const FilmSums alone = imageAlone();
    Image image{layout.width, layout.height, std::vector<Vec3f>(layout.pixels())};
    const int32_t exponent = layout.layers[0].scaleExponent;
    const auto mean = [&](size_t i) {
        return float(std::ldexp(double(alone.values[i]) / double(iterations), -exponent));
    };
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = {mean(3 * i), mean(3 * i + 1), mean(3 * i + 2)};
    return image;
}

std::vector<LayerImage> FilmSums::layerImages() const {
    requireConsistent(*this);
    const auto covered = std::ranges::find(layout.layers, LayerKind::Coverage, &FilmLayer::kind);
    const size_t coverage = size_t(covered - layout.layers.begin());
    std::vector<LayerImage> images;
    for (size_t index = layout.residueClasses() == 1 ? 1 : 0; index < layout.layers.size(); ++index) {
        const FilmLayer& from = layout.layers[index];
        if ((from.kind == LayerKind::Image && from.name.empty()) || from.kind == LayerKind::Blur) continue;
        LayerImage& to = images.emplace_back(LayerImage{from.name, from.channels, {}});
        const std::span<const int64_t> sums = layer(index);
        to.values.resize(sums.size());
        const bool overHits = unitOf(from.kind) == LayerUnit::Length;
        for (size_t i = 0; i < sums.size(); ++i) {
            const double count = overHits ? std::ldexp(double(layer(coverage)[i / from.channels.size()]),
                                                       -layout.layers[coverage].scaleExponent)
                                          : double(iterationsOf(index));
            if (count > 0) to.values[i] = float(std::ldexp(double(sums[i]) / count, -from.scaleExponent));
        }
    }
    return images;
}

std::string FilmSums::sha256() const {
    requireConsistent(*this);
    FilmSumsHash hash(*this);
    hash.add(values);
    return hash.finish();
}

FilmSumsHash::FilmSumsHash(const FilmSums& sums) : width_(sums.layout.width), height_(sums.layout.height) {
    for (size_t i = 0; i < sums.layout.layers.size(); ++i) {
        const FilmLayer& layer = sums.layout.layers[i];
        layers_.push_back({layer.scaleExponent, sums.iterationsOf(i), sums.layout.pixels() * layer.channels.size()});
    }
}

void FilmSumsHash::add(std::span<const int64_t> values) {
    while (!values.empty()) {
        const Layer& layer = layers_.at(layer_);
        if (inLayer_ == 0) {
            digest_.addValue(width_);
            digest_.addValue(height_);
            digest_.addValue(layer.scaleExponent);
            digest_.addValue(layer.iterations);
        }
        const size_t count = size_t(std::min<uint64_t>(values.size(), layer.values - inLayer_));
        digest_.addValues(values.first(count));
        values = values.subspan(count);
        inLayer_ += count;
        if (inLayer_ < layer.values) return;
        ++layer_;
        inLayer_ = 0;
    }
}

std::string FilmSumsHash::finish() {
    if (layer_ != layers_.size()) throw Error(ErrorCode::Usage, "A film's sums are not all hashed.");
    return hexadecimal(digest_.finish());
}

}  // namespace antipode
