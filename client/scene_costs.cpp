#include "client/scene_costs.h"

#include <algorithm>

#include "farm/jobs/technique_choice.h"
#include "renderengine/engine.h"

namespace antipode {
namespace {

constexpr size_t rounds = 9;

struct StageName {
    const char *stage, *part;
};

/// Stages by what a user would call their work, in the order that the parts are shown in.
constexpr StageName stageNames[] = {
    {"light emission", "light paths"},
    {"light trace", "light paths"},
    {"light scatter", "light paths"},
    {"splat visibility", "light paths seen by the camera"},
    {"camera rays", "camera paths"},
    {"camera trace", "camera paths"},
    {"camera scatter", "camera paths"},
    {"next-event visibility", "shadow rays to lamps"},
    {"connect", "connections"},
    {"connection visibility", "connections"},
    {"grid build", "merging"},
    {"merge", "merging"},
    {"interfaces", "glass that touches"},
};

const char* partOf(const std::string& stage) {
    for (const StageName& name : stageNames)
        if (stage == name.stage) return name.part;
    return "bookkeeping";
}

double total(const std::vector<StageTime>& stages) {
    double seconds = 0;
    for (const StageTime& stage : stages) seconds += stage.seconds;
    return seconds;
}

std::vector<PartCost> partsOf(const std::vector<StageTime>& stages) {
    std::vector<PartCost> parts;
    for (const StageName& name : stageNames)
        if (parts.empty() || parts.back().name != name.part) parts.push_back({name.part, 0});
    parts.push_back({"bookkeeping", 0});
    for (const StageTime& stage : stages)
        std::ranges::find(parts, std::string(partOf(stage.stage)), &PartCost::name)->seconds += stage.seconds;
    std::erase_if(parts, [](const PartCost& part) { return part.seconds == 0; });
    return parts;
}

/// One way of rendering the scene, timed whenever it is its turn.
class Contestant {
public:
    Contestant(const Scene& scene, const RenderSettings& settings, const std::string& device)
        : engine_(scene, settings, device) {
        engine_.render(1);  // drivers compile in the first
    }
    /// Returns the seconds that it took.
    double takeTurn() {
        engine_.reset();
        engine_.render(1);
        std::vector<StageTime> stages = engine_.statistics().stages;
        const double seconds = total(stages);
        if (seconds < total(fastest_) || fastest_.empty()) fastest_ = std::move(stages);
        return seconds;
    }
    const std::vector<StageTime>& fastest() const { return fastest_; }
    std::string device() const { return engine_.deviceName(); }

private:
    Engine engine_;
    std::vector<StageTime> fastest_;
};

}  // namespace

double SceneCosts::iterationSeconds() const {
    double seconds = 0;
    for (const PartCost& part : parts) seconds += part.seconds;
    return seconds;
}

SceneCosts measureSceneCosts(const Scene& scene, const RenderSettings& asked, const std::vector<SceneEffect>& effects,
                             const std::string& device, const std::function<void(const std::string&)>& step) {
    const RenderSettings settings = pilotSettings(asked);
    step("measuring an iteration");
    Contestant whole(scene, settings, device);
    for (size_t round = 0; round < rounds; ++round) whole.takeTurn();
    SceneCosts costs{whole.device(), settings.width, settings.height, {}, {}};
    for (const SceneEffect& effect : effects) {
        if (!effect.removable) continue;
        step(std::string("measuring what ") + effect.name + " cost");
        Contestant without(sceneWithout(scene, effect.key), settings, device);
        std::vector<double> ratios;
        for (size_t round = 0; round < rounds; ++round) ratios.push_back(whole.takeTurn() / without.takeTurn());
        std::ranges::sort(ratios);
        costs.effects.push_back({effect.key, effect.name, ratios[rounds / 2], ratios[1], ratios[rounds - 2]});
    }
    costs.parts = partsOf(whole.fastest());
    return costs;
}

}  // namespace antipode
