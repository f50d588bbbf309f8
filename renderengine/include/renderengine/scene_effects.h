// What a scene calls for, in words: of each effect that kernels know whether they are built with it for this scene.
#pragma once

#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

enum class EffectGroup { Shapes, Surfaces, Lamps, View };

/// "shapes", "surfaces", "lamps" or "camera".
const char* name(EffectGroup group);

struct SceneEffect {
    const char* key;  ///< for programs: "normal_maps"
    EffectGroup group;
    const char* name;     ///< "normal maps"
    const char* meaning;  ///< what it does for the picture, a few words
    bool present = false;
    bool removable = false;  ///< whether sceneWithout() can take it away
};

/// How many lights there are of one kind.
struct LightCount {
    const char *one, *many;  ///< "point lamp", "point lamps"
    size_t number = 0;
};

/// Of each kind of light, surfaces apart, how many the scene has.
std::vector<LightCount> lightCounts(const Scene& scene);

/// All effects, group by group; the same for every scene but for `present` and `removable`, which is of those present.
/// What is not present has neither code in the kernels nor memory on the device. Packs the scene as an engine does:
/// takes as long. Throws Error as validate() and the packing do.
std::vector<SceneEffect> sceneEffects(const Scene& scene);

/// The same scene but for that effect, to see what it costs. Needs one that is removable.
Scene sceneWithout(const Scene& scene, const std::string& key);

}  // namespace antipode
