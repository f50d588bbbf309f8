// What a job is: everything that decides its image's bytes on one class of device.
#pragma once

#include <string>

#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode {

struct JobDefinition {
    RenderSettings settings;  ///< resolved: size, initialRadius and maxPathLength are set from the scene
    std::string sceneHash;    ///< sceneHash() of the scene
    std::string kernelHash;   ///< kernelHash() of this build
};

/// Resolves the settings against the scene; the merge radius of every iteration follows from the result alone.
JobDefinition defineJob(const Scene& scene, const RenderSettings& settings);

/// What a node's renderings of the job can be equal to: its device's class, unless it traces another number of light
/// paths than was asked for because its device cannot bind the vertices of more.
std::string renderingClass(const std::string& deviceClass, const RenderSettings& settings, uint64_t lightPaths);

}  // namespace antipode
