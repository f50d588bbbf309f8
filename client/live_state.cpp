#include "client/live_state.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "client/error_report.h"

namespace antipode {

double shareDone(const LiveState& state) {
    if (state.done) return 1;
    if (!state.progress) return 0;
    const ProgressState& progress = *state.progress;
    double share = 0;
    if (progress.iterationLimit)
        share = double(progress.iterations + progress.iterationsInHand) / double(*progress.iterationLimit);
    if (progress.secondLimit) share = std::max(share, progress.elapsedSeconds / *progress.secondLimit);
    for (const ErrorCost& cost : state.costs)
        if (cost.asked && cost.forecast)
            share = std::max(share, progress.elapsedSeconds / (progress.elapsedSeconds + cost.forecast->seconds));
    return std::clamp(share, 0.0, 1.0);
}

std::string liveStateJson(const LiveState& state) {
    nlohmann::ordered_json json = state.progress ? progressValues(*state.progress) : nlohmann::ordered_json::object();
    json["scene"] = state.scene;
    json["job"] = state.job;
    json["phase"] = state.phase;
    json["rendering"] = state.rendering;
    json["done"] = state.done;
    json["share"] = shareDone(state);
    if (state.exposure) json["exposure"] = *state.exposure;
    if (state.progress && state.progress->error) json["limit"] = limitText(*state.progress->error);
    for (const view::ErrorPoint& p : state.history)
        json["history"].push_back({p.seconds, p.iterations, p.percent, p.low, p.high});
    for (const ErrorCost& cost : state.costs) {
        nlohmann::ordered_json told{{"percent", cost.percent}, {"asked", cost.asked}};
        if (cost.forecast) told.update({{"seconds", cost.forecast->seconds}, {"spread", cost.forecast->spread}});
        json["costs"].push_back(told);
    }
    for (const NodeReport& node : state.nodes)
        json["nodes"].push_back({{"name", node.name},
                                 {"device", node.device},
                                 {"state", node.state},
                                 {"detail", node.detail},
                                 {"iterations_per_second", node.iterationsPerSecond},
                                 {"leases", node.leases},
                                 {"committed", node.committed},
                                 {"lost", node.lost}});
    for (const StageTime& stage : state.stages)
        json["stages"].push_back({{"stage", stage.stage}, {"seconds", stage.seconds}, {"rays", stage.rays}});
    for (const LayerInfo& layer : layerTable())
        if (layer.kind < LayerKind::Albedo && state.techniques.has(layer.kind))
            json["techniques"].push_back(
                {{"bit", 1u << uint32_t(layer.kind)}, {"name", layer.option}, {"description", layer.description}});
    if (!state.notes.empty()) json["notes"] = state.notes;
    if (!state.ending.empty()) json["ending"] = state.ending;
    // A path need not be UTF-8.
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace antipode
