// antipode render: scene in, images out.
#include <iostream>

#include "client/commands.h"
#include "client/render_job.h"
#include "client/reports.h"
#include "proto/scene_loader.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

/// Before hours of rendering rather than after.
void checkOutputs(const RenderOptions& options) {
    checkWritable(options.exrPath);
    checkWritable(options.pngPath);
    if (options.statsPath) checkWritable(*options.statsPath);
    if (!options.checkpointPath.empty()) checkWritable(options.checkpointPath);
}

void writeOutputs(const RenderOptions& options, const RenderResult& result) {
    const Image image = result.sums.image();
    writeExr(options.exrPath, image, imageMetadata(result));
    writePng(options.pngPath, image);
    if (options.statsPath) writeFileAtomically(*options.statsPath, statsJson(result));
}

void printOutcome(const RenderOptions& options, const RenderResult& result) {
    if (!options.quiet)
        std::cout << summary(result) << "\nwrote " << options.exrPath << " and " << options.pngPath << std::endl;
    if (const std::string warning = eventWarning(result.sums.events); !warning.empty())
        std::cerr << "antipode: warning: " << warning << std::endl;
}

}  // namespace

void renderCommand(const std::vector<std::string>& arguments) {
    const std::optional<RenderOptions> options = parseRenderOptions(arguments);
    if (!options) return;
    checkOutputs(*options);
    const auto scene = std::make_shared<const Scene>(loadScene(options->scenePath));
    if (!options->quiet)
        for (const std::string& notice : scene->notices) std::cerr << "antipode: note: " << notice << std::endl;
    const RenderResult result = runRender(*options, scene);
    writeOutputs(*options, result);
    printOutcome(*options, result);
    if (!result.failure.empty()) throw Error(ErrorCode::Device, result.failure);
}

}  // namespace antipode
