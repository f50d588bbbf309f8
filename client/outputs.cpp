#include "client/outputs.h"

#include "client/reports.h"
#include "renderengine/io/files.h"

namespace antipode {

void checkOutputs(const RenderOptions& options) {
    checkWritable(options.exrPath);
    checkWritable(options.pngPath);
    if (options.statsPath) checkWritable(*options.statsPath);
    if (!options.checkpointPath.empty()) checkWritable(options.checkpointPath);
}

void writeImages(const RenderOptions& options, const RenderResult& result) {
    const Image image = result.sums.image();
    writeExr(options.exrPath, image, imageMetadata(result), result.sums.layerImages());
    writePng(options.pngPath, image);
}

}  // namespace antipode
