// antipode explain: what a scene has, what is simulated for it, and what that costs.
#include <iostream>

#include <unistd.h>

#include "client/commands.h"
#include "client/explanation.h"
#include "farm/jobs/job_definition.h"
#include "client/progress.h"
#include "client/render_options.h"
#include "proto/scene_loader.h"
#include "renderengine/devices.h"
#include "terminal/command_line.h"

namespace antipode {
namespace {

/// Bold and dim, unless the user wants none (no-color.org) or something else reads.
bool isStyled() { return ::isatty(STDOUT_FILENO) == 1 && !std::getenv("NO_COLOR"); }

}  // namespace

void explainCommand(const std::vector<std::string>& arguments) {
    std::string scenePath, device;
    RequestedSize size;
    RenderSettings settings;
    bool json = false, costs = true;
    if (!parseCommandLine(
            "antipode explain", "Tells what a scene has, what is simulated for it and why, and what that costs here.",
            {{"SCENE", "", "scene: a scene (.textproto) or a model (.glb .gltf .obj …)", "", assignText(scenePath)},
             {"--technique", "NAME", "whose cost to measure", settings.technique, assignText(settings.technique), false,
              techniqueNames()},
             {"--width", "PIXELS", "image width", "the scene's", assignWhole(size.width, 1, SettingsLimits::side)},
             {"--height", "PIXELS", "image height", "the scene's", assignWhole(size.height, 1, SettingsLimits::side)},
             {"--max-path-length", "EDGES", "longest light path", "unlimited",
              assignNumber(settings, &RenderSettings::maxPathLength)},
             {"--device", "DEVICE", "device to measure on", "the best one", assignText(device)},
             {"--no-costs", "", "measure nothing", "", assignFlag(costs, false)},
             {"--json", "", "print a JSON object", "", assignFlag(json, true)}},
            arguments))
        return;
    Progress progress(false);
    progress.showStep("reading " + scenePath);
    ImportOptions import;
    import.studio = Studio::Soft;
    const Scene scene = loadScene(scenePath, import);
    const JobDefinition job = resolveJob(scene, settings, size);
    Explanation explanation = explainScene(scene, job.settings);
    if (costs && hasUsableDevice())
        explanation.costs = measureSceneCosts(scene, job.settings, explanation.effects, device,
                                              [&](const std::string& what) { progress.showStep(what); });
    progress.clear();
    std::cout << (json ? explanationJson(explanation) : explanationText(explanation, isStyled())) << std::flush;
}

}  // namespace antipode
