#include "client/outputs.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>

#include "client/reports.h"
#include "renderengine/denoise.h"
#include "renderengine/error_estimate.h"
#include "renderengine/exposure.h"
#include "renderengine/io/files.h"
#include "renderengine/pictures.h"

namespace antipode {
namespace {

/// Whether the film has enough iterations to tell its noise.
bool tellsNoise(const FilmSums& sums) {
    return std::ranges::count_if(sums.residueIterations, [](uint64_t n) { return n > 0; }) >= 2;
}

/// Errors of the film, or so many NaN where it has too few iterations to tell any.
template <class Errors>
std::vector<float> whereKnown(const FilmSums& sums, size_t count, const Errors& errors) {
    return tellsNoise(sums) ? errors(sums) : std::vector<float>(count, std::numeric_limits<float>::quiet_NaN());
}

LayerImage radianceLayer(const char* name, const Image& image) {
    LayerImage layer{name, "RGB", {}};
    layer.values.reserve(3 * image.pixels.size());
    for (const Vec3f& pixel : image.pixels) layer.values.insert(layer.values.end(), {pixel.x, pixel.y, pixel.z});
    return layer;
}

/// What merging blurs, where that is known: a technique without merging has no bias, and a job that was begun without
/// its estimate tells none.
std::vector<float> biasOf(const RenderResult& result) {
    const FilmLayout& layout = result.sums.layout;
    if (merges(result.settings) && layout.count(LayerKind::Blur) == 0)
        return std::vector<float>(layout.pixels(), std::numeric_limits<float>::quiet_NaN());
    return whereKnown(result.sums, layout.pixels(), mergeBias);
}

}  // namespace

void checkOutputs(const RenderOptions& options) {
    checkWritable(options.exrPath);
    checkWritable(options.pngPath);
    if (options.statsPath) checkWritable(*options.statsPath);
    if (options.errorMapPath) checkWritable(*options.errorMapPath);
    if (!options.checkpointPath.empty()) checkWritable(options.checkpointPath);
}

double writeShownImage(const std::string& path, const Image& image, std::optional<double> exposure) {
    const double stops = exposure ? *exposure : autoExposure(image);
    writePng(path, exposed(image, stops));
    return stops;
}

std::string shownExposure(double stops) {
    char text[32];
    std::snprintf(text, sizeof text, stops == 0 ? "exposure %.0f" : "exposure %+.4g", stops);
    return text;
}

void writeErrorMap(const std::string& path, const FilmSums& sums) {
    writeFileAtomically(path, encodeErrorMap(sums.layout.width, sums.layout.height,
                                             whereKnown(sums, sums.layout.pixels(), relativeStandardErrors),
                                             errorMapLow, errorMapHigh));
}

double writeImages(const RenderOptions& options, const RenderResult& result) {
    Image image = result.sums.image();
    std::vector<LayerImage> layers = result.sums.layerImages();
    ImageMetadata metadata = imageMetadata(result);
    if (options.denoise && tellsNoise(result.sums)) {
        layers.push_back(radianceLayer("noisy", image));
        Denoised denoised = denoise(result.sums);
        image = std::move(denoised.image);
        metadata["antipode.denoised"] = denoised.openImageDenoise ? "regression, Open Image Denoise" : "regression";
    } else if (options.denoise) {
        std::cerr << "antipode: note: one iteration does not tell noise from light: nothing is denoised" << std::endl;
    }
    if (options.noiseLayer)
        layers.push_back({"noise", "RGB", whereKnown(result.sums, result.sums.layout.offset(1), standardErrors)});
    const RenderSettings& settings = result.settings;
    if (options.biasLayer) layers.push_back({"bias", "Y", biasOf(result)});
    writeExr(options.exrPath, image, metadata, layers,
             FramePlacement{settings.width, settings.height, filmWindow(settings)});
    if (options.errorMapPath) writeErrorMap(*options.errorMapPath, result.sums);
    return writeShownImage(options.pngPath, image, options.exposure);
}

}  // namespace antipode
