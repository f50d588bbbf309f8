#include "client/view/picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "renderengine/exposure.h"
#include "renderengine/pictures.h"

namespace antipode::view {
namespace {

constexpr uint64_t mostPixels = 1u << 22;

double monotonicSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool isTechnique(LayerKind kind) { return kind < LayerKind::Albedo; }

/// Sums of three channels, of one layer or of several that are added, as means.
struct Means {
    const FilmSums& sums;
    size_t firstLayer, layers;
    double divisor, unit;  ///< iterations; what a sum counts

    Means(const FilmSums& film, size_t first, size_t count)
        : sums(film),
          firstLayer(first),
          layers(count),
          divisor(double(film.iterations)),
          unit(std::ldexp(1.0, -film.layout.layers[first].scaleExponent)) {}

    /// Of value `at` of each layer. The film keeps their sum within 64 bits.
    double at(const std::vector<const int64_t*>& values, size_t value) const {
        int64_t sum = 0;
        for (const int64_t* layer : values) sum += layer[value];
        return double(sum) / divisor * unit;
    }

    void fillRow(Image& image, uint32_t row, uint32_t reduction) const {
        const uint32_t width = sums.layout.width, height = sums.layout.height;
        std::vector<const int64_t*> values;
        for (size_t k = 0; k < layers; ++k) values.push_back(sums.values.data() + sums.layout.offset(firstLayer + k));
        for (uint32_t column = 0; column < image.width; ++column) {
            Vec3d mean;
            const uint32_t endX = std::min((column + 1) * reduction, width),
                           endY = std::min((row + 1) * reduction, height);
            for (uint32_t y = row * reduction; y < endY; ++y)
                for (uint32_t x = column * reduction; x < endX; ++x) {
                    const size_t value = 3 * (size_t(y) * width + x);
                    mean = mean + Vec3d{at(values, value), at(values, value + 1), at(values, value + 2)};
                }
            const double count = double(endX - column * reduction) * double(endY - row * reduction);
            image.pixels[size_t(row) * image.width + column] = Vec3f(mean * (1 / count));
        }
    }
};

}  // namespace

uint32_t pictureReduction(uint32_t width, uint32_t height) {
    uint32_t reduction = 1;
    const auto side = [&](uint32_t size) { return (uint64_t(size) + reduction - 1) / reduction; };
    while (side(width) * side(height) > mostPixels) ++reduction;
    return reduction;
}

void PictureTaker::begin(const FilmSums& sums) {
    const FilmLayout& layout = sums.layout;
    picture_.emplace();
    picture_->iterations = sums.iterations;
    picture_->reduction = pictureReduction(layout.width, layout.height);
    const uint32_t r = picture_->reduction;
    Image blank{(layout.width + r - 1) / r, (layout.height + r - 1) / r, {}};
    blank.pixels.resize(size_t(blank.width) * blank.height);
    for (const FilmLayer& layer : layout.layers)
        if (isTechnique(layer.kind)) picture_->techniques.push_back({layer.kind, blank});
    picture_->image = std::move(blank);
    nextRow_ = 0;
}

void PictureTaker::takeRow(const FilmSums& sums, uint32_t row) {
    Means(sums, 0, sums.layout.residueClasses()).fillRow(picture_->image, row, picture_->reduction);
    for (TechniquePicture& technique : picture_->techniques) {
        const auto layer = std::ranges::find(sums.layout.layers, technique.kind, &FilmLayer::kind);
        Means(sums, size_t(layer - sums.layout.layers.begin()), 1).fillRow(technique.image, row, picture_->reduction);
    }
}

std::optional<Picture> PictureTaker::take(const FilmSums& sums, double seconds) {
    const double end = monotonicSeconds() + seconds;
    if (!picture_) begin(sums);
    do {
        takeRow(sums, nextRow_++);
    } while (nextRow_ < picture_->image.height && monotonicSeconds() < end);
    return nextRow_ < picture_->image.height ? std::nullopt : std::exchange(picture_, std::nullopt);
}

Picture PictureTaker::takeWhole(const FilmSums& sums) {
    picture_.reset();
    return *take(sums, std::numeric_limits<double>::infinity());
}

EncodedPicture encodePicture(const Picture& picture, uint32_t techniques) {
    const auto shown = [&](const TechniquePicture& technique) {
        return (techniques >> uint32_t(technique.kind) & 1) != 0;
    };
    EncodedPicture encoded;
    encoded.width = picture.image.width;
    encoded.height = picture.image.height;
    encoded.reduction = picture.reduction;
    encoded.iterations = picture.iterations;
    encoded.stops = autoExposure(picture.image);
    encoded.exponent = int(std::lround(encoded.stops));
    const double factor = std::ldexp(1.0, encoded.exponent);
    if (std::ranges::all_of(picture.techniques, shown)) {
        encoded.halves = encodeHalfRgb(picture.image, factor);
        return encoded;
    }
    Image sum{picture.image.width, picture.image.height, std::vector<Vec3f>(picture.image.pixels.size())};
    for (const TechniquePicture& technique : picture.techniques)
        if (shown(technique))
            for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] = sum.pixels[i] + technique.image.pixels[i];
    encoded.halves = encodeHalfRgb(sum, factor);
    return encoded;
}

}  // namespace antipode::view
