// antipode render: scene in, images out.
#include <filesystem>
#include <iostream>

#include "client/commands.h"
#include "client/frames.h"
#include "client/interrupt.h"
#include "client/live_view.h"
#include "client/outputs.h"
#include "client/progress.h"
#include "client/render_job.h"
#include "client/reports.h"
#include "proto/scene_loader.h"
#include "renderengine/error.h"
#include "renderengine/io/files.h"

namespace antipode {
namespace {

void printOutcome(const RenderOptions& options, const RenderResult& result, double exposure) {
    if (options.progressJson)
        std::cout << outcomeJson(result, options.exrPath) << std::endl;
    else if (!options.quiet)
        std::cout << summary(result) << "\nstopped because " << clause(result.stoppedBy) << "\nwrote "
                  << options.exrPath << " and " << options.pngPath << " (at " << shownExposure(exposure)
                  << (options.exposure ? ")" : ", auto)") << std::endl;
    if (const std::string warning = eventWarning(result.sums.events); !warning.empty())
        std::cerr << "antipode: warning: " << warning << std::endl;
}

/// What the page says at the end of an image.
std::vector<std::string> ending(const RenderOptions& options, const RenderResult& result) {
    return {"Stopped because " + std::string(clause(result.stoppedBy)) + ".",
            "Wrote " + options.exrPath + " and " + options.pngPath + "."};
}

/// Renders one image; nothing where it is a frame that is there. `view` may be null.
std::optional<RenderResult> render(const RenderOptions& options, SignalGuard& signals, LiveView* view) {
    Progress progress(
        options.quiet, options.progressJson,
        [view](const std::string& step) {
            if (view) view->showStep(step);
        },
        [view](const std::string& line) {
            if (view) view->note(line);
        });
    progress.showStep("reading " + options.scenePath);
    const auto scene = std::make_shared<const Scene>(loadScene(options.scenePath, options.import, options.changes));
    JobDefinition job = resolveRender(options, *scene, progress);
    if (options.frames && !options.overwrite && std::filesystem::exists(options.exrPath) &&
        isRendered(options, job.hash())) {
        if (!options.quiet) progress.interject("antipode: note: " + options.exrPath + " is there and complete");
        return std::nullopt;
    }
    if (!options.quiet)
        for (const std::string& notice : scene->notices) progress.interject("antipode: note: " + notice);
    return runRender(options, std::move(job), scene, signals, progress, view);
}

/// False where a signal or the page ended it.
bool renderImage(const RenderOptions& options, LiveView* view, bool last) {
    checkOutputs(options);
    SignalGuard signals(!options.quiet);
    if (view) view->beginImage(options);
    const std::optional<RenderResult> result = render(options, signals, view);
    if (!result) return true;
    const double exposure = writeImages(options, *result);
    if (options.statsPath) writeFileAtomically(*options.statsPath, statsJson(*result));
    printOutcome(options, *result, exposure);
    const bool asked = result->stoppedBy == StopReason::Signal || result->stoppedBy == StopReason::Page;
    if (view && (last || asked))
        view->end(result->earlier.seconds + result->wallSeconds, result->error, ending(options, *result));
    if (!result->failure.empty()) throw Error(ErrorCode::Device, result->failure);
    return !asked;
}

}  // namespace

void renderCommand(const std::vector<std::string>& arguments) {
    const std::optional<RenderOptions> options = parseRenderOptions(arguments);
    if (!options) return;
    std::optional<LiveView> view;
    if (options->view) {
        view.emplace(*options);
        std::cerr << "antipode: seen live at " << view->address() << (options->viewTokenPath.empty() ? "" : "#TOKEN")
                  << std::endl;
    }
    LiveView* const shown = view ? &*view : nullptr;
    if (!options->frames) {
        renderImage(*options, shown, true);
        return;
    }
    for (uint32_t frame = options->frames->first; frame <= options->frames->last; ++frame)
        if (!renderImage(optionsOfFrame(*options, frame), shown, frame == options->frames->last)) return;
}

}  // namespace antipode
