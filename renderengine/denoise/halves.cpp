#include "denoise/halves.h"

#include <algorithm>

#include "film/class_contrasts.h"
#include "renderengine/denoise.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

/// Of what smooths variances.
constexpr int32_t varianceRadius = 1;

RgbPlanes rgbPlanes(const FilmLayout& layout) {
    const Plane plane(layout.width, layout.height, planeMargin);
    return {plane, plane, plane};
}

void fillMargins(RgbPlanes& planes) {
    for (Plane& plane : planes) plane.fillMargin();
}

/// A layer of the film's images by its kind.
const LayerImage& layerOf(const std::vector<LayerImage>& images, LayerKind kind) {
    const LayerInfo& info = layerTable()[size_t(kind)];
    const auto found = std::ranges::find_if(
        images, [&](const LayerImage& image) { return image.name == info.name && image.channels == info.channels; });
    if (found == images.end())
        throw Error(ErrorCode::Usage, std::string("Denoising needs the layer ") + info.option + ".");
    return *found;
}

/// Half of what is covered lies at no more than this depth; 1 where nothing is.
float medianDepth(const std::vector<float>& depth, const std::vector<float>& coverage) {
    std::vector<float> covered;
    for (size_t i = 0; i < depth.size(); ++i)
        if (coverage[i] > 0 && depth[i] > 0) covered.push_back(depth[i]);
    if (covered.empty()) return 1;
    const auto middle = covered.begin() + ptrdiff_t(covered.size() / 2);
    std::ranges::nth_element(covered, middle);
    return *middle;
}

}  // namespace

Halves halvesOf(const FilmSums& sums) {
    const ClassContrasts contrasts(sums);
    if (contrasts.classes() < 2) throw Error(ErrorCode::Usage, "Denoising takes iterations of two classes at least.");
    const FilmLayout& layout = sums.layout;
    Halves result{{Half{rgbPlanes(layout), rgbPlanes(layout), 0}, Half{rgbPlanes(layout), rgbPlanes(layout), 0}},
                  rgbPlanes(layout),
                  rgbPlanes(layout)};
    std::array<double, 2> iterations{};
    for (uint32_t k = 0; k < contrasts.classes(); ++k) iterations[k % 2] += contrasts.iterations(k);
    for (size_t h = 0; h < 2; ++h) result.half[h].share = float(iterations[h] / contrasts.iterations());
    size_t index = 0;
    for (int32_t y = 0; y < int32_t(layout.height); ++y) {
        for (int32_t x = 0; x < int32_t(layout.width); ++x) {
            for (size_t c = 0; c < 3; ++c, ++index) {
                const ClassContrasts::Means means = contrasts.means(index);
                const double variance = contrasts.variance(means);
                std::array<double, 2> mean{};
                for (uint32_t k = 0; k < contrasts.classes(); ++k)
                    mean[k % 2] += means[k] * (contrasts.iterations(k) / iterations[k % 2]);
                for (size_t h = 0; h < 2; ++h) {
                    result.half[h].mean[c].row(y)[x] = float(mean[h]);
                    result.half[h].variance[c].row(y)[x] = float(variance * (contrasts.iterations() / iterations[h]));
                }
                result.mean[c].row(y)[x] =
                    float((mean[0] * iterations[0] + mean[1] * iterations[1]) / contrasts.iterations());
                result.variance[c].row(y)[x] = float(variance);
            }
        }
    }
    for (Half& half : result.half) {
        for (Plane& variance : half.variance) variance = smoothed(variance, varianceRadius);
        fillMargins(half.mean);
        fillMargins(half.variance);
    }
    return result;
}

Features featuresOf(const FilmSums& sums) {
    const std::vector<LayerImage> images = sums.layerImages();
    const std::vector<float>& albedo = layerOf(images, LayerKind::Albedo).values;
    const std::vector<float>& normal = layerOf(images, LayerKind::Normal).values;
    const std::vector<float>& depth = layerOf(images, LayerKind::Depth).values;
    const std::vector<float>& coverage = layerOf(images, LayerKind::Coverage).values;
    const float middle = medianDepth(depth, coverage);
    const Plane plane(sums.layout.width, sums.layout.height, planeMargin);
    Features features{plane, plane, plane, plane, plane, plane, plane};
    size_t pixel = 0;
    for (int32_t y = 0; y < plane.height(); ++y) {
        for (int32_t x = 0; x < plane.width(); ++x, ++pixel) {
            for (size_t c = 0; c < 3; ++c) {
                features[c].row(y)[x] = albedo[3 * pixel + c];
                features[3 + c].row(y)[x] = normal[3 * pixel + c];
            }
            const float z = std::max(depth[pixel], 0.0F);
            features[6].row(y)[x] = coverage[pixel] > 0 ? z / (z + middle) : 1;
        }
    }
    for (Plane& feature : features) feature.fillMargin();
    return features;
}

}  // namespace antipode
