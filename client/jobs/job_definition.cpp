#include "client/jobs/job_definition.h"

#include "proto/scene_loader.h"
#include "renderengine/engine.h"

namespace antipode {

JobDefinition defineJob(const Scene& scene, const RenderSettings& settings) {
    JobDefinition job{settings, sceneHash(scene), kernelHash()};
    job.settings.initialRadius = initialRadius(scene, settings);
    if (!job.settings.maxPathLength) job.settings.maxPathLength = scene.maxPathLength;
    return job;
}

std::string renderingClass(const std::string& deviceClass, const RenderSettings& settings, uint64_t lightPaths) {
    const uint64_t wanted = settings.lightPathCount.value_or(uint64_t(settings.width) * settings.height);
    if (lightPaths == 0 || lightPaths == wanted) return deviceClass;
    return deviceClass + " with " + std::to_string(lightPaths) + " light paths";
}

}  // namespace antipode
