// What a scene has and what will be simulated for it, to be read by people and by programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/jobs/job_definition.h"
#include "client/scene_costs.h"
#include "renderengine/light_paths.h"
#include "renderengine/scene_effects.h"

namespace antipode {

/// One kind of light that a scene can have, and which techniques render it.
struct LightRow {
    std::string words, paths;      ///< "caustics of …", "LS+DE, LS+D…DE"
    std::vector<bool> techniques;  ///< in the order of Explanation::techniques
};

struct Explanation {
    std::string scene;
    uint64_t triangles = 0, spheres = 0, lamps = 0;  ///< lamps: points, spots, suns and the sky
    uint32_t width = 0, height = 0;
    std::string technique;
    std::vector<std::string> techniques;  ///< by name, in the order of the table
    std::vector<LightRow> light;
    std::vector<SceneEffect> effects;
    std::optional<SceneCosts> costs;
};

/// Packs the scene; needs no device. `settings` are resolved. Costs are left open.
Explanation explainScene(const Scene& scene, const RenderSettings& settings);

/// Pages for a terminal, with its bold and dim where `styled`.
std::string explanationText(const Explanation& explanation, bool styled);
std::string explanationJson(const Explanation& explanation);

/// What a render says of its scene before it begins: what is there, which light it can have, and how it is rendered.
std::vector<std::string> sceneInShort(const Scene& scene, const JobDefinition& job);

}  // namespace antipode
