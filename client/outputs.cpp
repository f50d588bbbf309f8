#include "client/outputs.h"

#include <cstdio>

#include "client/reports.h"
#include "renderengine/exposure.h"
#include "renderengine/io/files.h"

namespace antipode {

void checkOutputs(const RenderOptions& options) {
    checkWritable(options.exrPath);
    checkWritable(options.pngPath);
    if (options.statsPath) checkWritable(*options.statsPath);
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

double writeImages(const RenderOptions& options, const RenderResult& result) {
    const Image image = result.sums.image();
    writeExr(options.exrPath, image, imageMetadata(result), result.sums.layerImages());
    return writeShownImage(options.pngPath, image, options.exposure);
}

}  // namespace antipode
