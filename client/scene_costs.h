// What rendering a scene costs on this machine, and what each of its effects adds to that.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "renderengine/scene_effects.h"
#include "renderengine/settings.h"

namespace antipode {

/// Device time of an iteration.
struct PartCost {
    std::string name;  ///< "merging", "camera paths" …
    double seconds = 0;
};

/// Of one effect: how many times as long an iteration takes with it as without, rendered in turns. The median of all
/// turns, and the second least and second greatest: where 1 lies between those, it costs nothing that could be
/// measured.
struct EffectCost {
    std::string key, name;
    double ratio = 1, low = 1, high = 1;
};

struct SceneCosts {
    std::string device;
    uint32_t width = 0, height = 0;  ///< of the image that was rendered for it
    std::vector<PartCost> parts;     ///< add up to the iteration; the order of a path's life
    std::vector<EffectCost> effects;

    double iterationSeconds() const;
};

/// Renders a few iterations of a small image, of the scene as it is and without each effect that can be taken away.
/// Takes a second or two an effect. Needs resolved settings. `step` is called before each part. Throws Error, of Device
/// where the machine has none.
SceneCosts measureSceneCosts(const Scene& scene, const RenderSettings& settings,
                             const std::vector<SceneEffect>& effects, const std::string& device,
                             const std::function<void(const std::string&)>& step);

}  // namespace antipode
