// The light transport algorithms as choices of terms in one weighted sum: a table, not a class hierarchy.
#pragma once

#include <cstdint>

#include "renderengine/light_paths.h"
#include "renderengine/settings.h"

namespace antipode {

/// What the kernels do and how many samples each technique takes; the counts are what every MIS weight is made of.
struct TechniquePlan {
    uint32_t terms = 0;       ///< TERM_* bits of kernels/shared/layout.h
    bool lightPaths = false;  ///< whether the light pass runs at all
    bool cameraPaths = false;
};

/// The plan for the settings' technique or single term, less what is to be left out and what the scene cannot use:
/// without an emitter that a path could meet (a surface or an environment) nothing looks for one. Throws Error(Usage)
/// with a list of names where the technique is unknown or has not what is to be left out, or where a single (s,t) does
/// not exist.
TechniquePlan planTechnique(const RenderSettings& settings, bool hasMeetableEmitters = true);

/// Whether some technique of the plan, which is no single one, makes paths of this class.
bool makes(const TechniquePlan& plan, const PathClass& paths);

}  // namespace antipode
