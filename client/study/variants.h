// What a study renders: techniques, and knobs of accuracy that are turned on one of them.
#pragma once

#include <string>
#include <vector>

#include "renderengine/settings.h"

namespace antipode::study {

/// One way to render a scene. A knob's price is told against the variant that differs from it in that knob alone.
struct Variant {
    std::string name;     ///< what --knobs takes, "double"; a technique's own name for a technique
    std::string label;    ///< begins a sentence: "Double precision"
    std::string against;  ///< name of the variant that it is measured against; empty where it is one of those
    bool technique = false;
    RenderSettings settings;  ///< the technique; turnKnob() does the rest
};

/// Techniques first, `base` before the others, then every knob on `base`.
std::vector<Variant> allVariants(const std::string& base);

/// Turns the knob of that name in settings whose size is known; techniques turn none.
void turnKnob(const std::string& name, RenderSettings& settings);

/// Those of `allVariants(base)` in the list, parted by commas, and what they are measured against; all with "all", the
/// techniques with "techniques". Throws Error(Usage) for other names, with the nearest.
std::vector<Variant> chooseVariants(const std::string& base, const std::string& list);

}  // namespace antipode::study
