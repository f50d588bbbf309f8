// What a job is: everything that decides its image's bytes on one class of device.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "farm/jobs/technique_choice.h"
#include "renderengine/film_layout.h"
#include "renderengine/light_paths.h"
#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode {

struct JobDefinition {
    RenderSettings settings;  ///< resolved: size, initialRadius and maxPathLength are set
    std::string sceneHash;    ///< sceneHash() of the scene
    std::string kernelHash;   ///< kernelHash() of this build
    /// The film's layers at their scales, where nodes are not this process alone: what they deliver must be of it.
    /// Where it is empty the first result decides.
    FilmLayout film = {};
    /// Light that the scene can have and the image will not: classes that nothing in the technique makes.
    std::vector<PathClass> missing{};
    /// Why it is this technique, where it was to be chosen.
    std::optional<TechniqueChoice> choice{};

    /// wire::jobHash() of the first three: equal for equal jobs, whatever machine resolved them.
    std::string hash() const;
};

/// Pixels; what is left open follows from the scene.
struct RequestedSize {
    std::optional<uint32_t> width, height;
};

/// What may be decided for a job that its settings do not say.
struct ResolveOptions {
    bool allowMissing = false;  ///< light that the technique would have had may be left out
    PilotOptions pilot{};       ///< where the technique is to be chosen
    bool tellsBias = false;     ///< the film has a blur layer where the technique merges, and none elsewhere
};

/// The one place where a job is resolved: nodes, checkpoints and reports get the result and decide nothing. The size is
/// the scene's preferred one unless given; a side given alone takes the other with it in the scene's aspect ratio.
/// A technique that is automaticTechnique is chosen: here, once, and never again; what nodes, checkpoints and hashes
/// see is the one that was taken. Needs no device but the pilot's. Throws Error(Usage) for settings that no engine
/// takes; and where what is left out (settings.without) takes light away, unless that is allowed.
JobDefinition resolveJob(const Scene& scene, const RenderSettings& asked, const RequestedSize& size = {},
                         const ResolveOptions& options = {});

/// What a node's renderings of the job can be equal to: its device's class, unless it traces another number of light
/// paths than was asked for because its device cannot bind the vertices of more.
std::string renderingClass(const std::string& deviceClass, const RenderSettings& settings, uint64_t lightPaths);

}  // namespace antipode
