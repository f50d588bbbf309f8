// Which technique suits a scene: what can be said from its lights and surfaces, and then what a pilot measures.
#pragma once

#include <string>
#include <vector>

#include "renderengine/renderer.h"
#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode {

/// What --technique takes for a choice by scene.
inline constexpr const char* automaticTechnique = "auto";

/// What a pilot may take, and what it renders with.
struct PilotOptions {
    RendererFactory renderers;  ///< without one there is no pilot
    double seconds = 3;         ///< device time of its iterations, about; building comes on top
};

/// What the pilot found of one technique.
struct CandidateMeasure {
    std::string technique;
    double variance = 0;      ///< of one iteration, relative as relMSE: mean of σ²/(reference² + 0.01)
    double trimmed = 0;       ///< the same without the worst thousandth of the pixels
    double seconds = 0;       ///< device time of an iteration of the pilot's image
    bool losesLight = false;  ///< it is darker somewhere than vcm by more than both can err

    /// Time to the same error, in that of `other`: by all pixels or without the worst, whichever speaks against it. One
    /// bright sample must not decide, and what makes many must not win.
    double timeBeside(const CandidateMeasure& other) const;
};

struct TechniqueChoice {
    std::string technique;
    std::string reason;                      ///< one sentence without a full stop
    std::vector<CandidateMeasure> measures;  ///< of the pilot; none where there was none
};

/// Path tracing, bidirectional path tracing or vertex connection and merging: a technique that lacks light which vcm
/// renders is none of them, and vcm is taken unless another one reaches the same error in four fifths of its time. Sets
/// technique and what is left out of it; all else of `settings` is resolved but for the radius. Runs no clock: device
/// time is what the renderers say. Throws Error as the renderers do.
TechniqueChoice chooseTechnique(const Scene& scene, RenderSettings& settings, const PilotOptions& pilot);

/// The same settings for that technique of the table: what it has not need not be left out of it.
RenderSettings withTechnique(RenderSettings settings, const std::string& name);

/// The same render as a small image: of 128² pixels at most, where as many light vertices are in the reach of a merge;
/// no layers. `settings.initialRadius` is set.
RenderSettings pilotSettings(RenderSettings settings);

}  // namespace antipode
