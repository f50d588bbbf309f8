#include "farm/jobs/job_definition.h"

#include <algorithm>
#include <cmath>

#include "proto/scene_loader.h"
#include "proto/wire/job_messages.h"
#include "renderengine/engine.h"
#include "renderengine/error.h"

namespace antipode {
namespace {

/// The side that keeps the preferred aspect ratio.
uint32_t scaled(uint32_t side, uint32_t otherPreferred, uint32_t preferred) {
    const double other = std::max(1.0, std::round(double(side) * otherPreferred / preferred));
    return uint32_t(std::min(other, double(SettingsLimits::pixels)));
}

void resolveSize(const RequestedSize& size, const Scene& scene, RenderSettings& settings) {
    settings.width = size.width    ? *size.width
                     : size.height ? scaled(*size.height, scene.imageWidth, scene.imageHeight)
                                   : scene.imageWidth;
    settings.height = size.height  ? *size.height
                      : size.width ? scaled(*size.width, scene.imageHeight, scene.imageWidth)
                                   : scene.imageHeight;
}

/// What has to be tried on the scene before it is known. All choices that need pilot paths or pilot iterations stand
/// here, so that they are made once, before anything is hashed or sent.
void resolveByPilot(const Scene& scene, const ResolveOptions& options, bool choose, JobDefinition& job) {
    if (choose) job.choice = chooseTechnique(scene, job.settings, options.pilot);
    job.settings.initialRadius = initialRadius(scene, job.settings);
}

/// What is left out may take time, but no light.
void requireNothingLost(const LightPathFacts& facts, const RenderSettings& settings,
                        const std::vector<PathClass>& missing) {
    RenderSettings whole = settings;
    whole.without = {};
    const std::vector<PathClass> anyway = missingClasses(facts, whole);
    std::vector<PathClass> lost;
    for (const PathClass& c : missing)
        if (std::ranges::find(anyway, c) == anyway.end()) lost.push_back(c);
    if (lost.empty()) return;
    throw Error(ErrorCode::Usage, "the technique " + settings.technique + " without " + name(settings.without) +
                                      " renders no " + described(lost) +
                                      ", which this scene can have; leave less out, or render the image without that "
                                      "light (--allow-missing)");
}

}  // namespace

std::string JobDefinition::hash() const { return wire::jobHash(settings, sceneHash, kernelHash); }

JobDefinition resolveJob(const Scene& scene, const RenderSettings& asked, const RequestedSize& size,
                         const ResolveOptions& options) {
    JobDefinition job{asked, sceneHash(scene), kernelHash()};
    RenderSettings& settings = job.settings;
    resolveSize(size, scene, settings);
    if (!settings.maxPathLength) settings.maxPathLength = scene.maxPathLength;
    const bool choose = settings.technique == automaticTechnique;
    if (choose) settings.technique = techniqueTable().front().name;
    checkSettings(settings);
    if (!settings.single) {
        const LightPathFacts facts = lightPathFacts(scene);
        job.missing = missingClasses(facts, settings);
        if (!options.allowMissing) requireNothingLost(facts, settings, job.missing);
    }
    resolveByPilot(scene, options, choose, job);
    settings.layers.remove(LayerKind::Blur);
    if (options.tellsBias && merges(settings)) settings.layers.add(LayerKind::Blur);
    return job;
}

std::string renderingClass(const std::string& deviceClass, const RenderSettings& settings, uint64_t lightPaths) {
    const uint64_t wanted = settings.lightPathCount.value_or(framePixels(settings));
    if (lightPaths == 0 || lightPaths == wanted) return deviceClass;
    return deviceClass + " with " + std::to_string(lightPaths) + " light paths";
}

}  // namespace antipode
