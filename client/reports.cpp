#include "client/reports.h"

#include <cctype>
#include <sstream>
#include <string_view>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "client/error_report.h"
#include "renderengine/io/suggest.h"
#include "terminal/text.h"
#include "renderengine/error_classes.h"

namespace antipode {
namespace {

uint64_t peakMemoryBytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return uint64_t(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

/// The shortest decimal text that reads back as the same double.
std::string exact(double value) { return nlohmann::json(value).dump(); }

/// "non_finite" → "nonFinite".
std::string camelCase(std::string_view key) {
    std::string text;
    for (size_t i = 0; i < key.size(); ++i) text += key[i] == '_' ? char(std::toupper(key[++i])) : key[i];
    return text;
}

nlohmann::ordered_json counters(const EventCounts& events) {
    nlohmann::ordered_json json;
    for (size_t kind = 0; kind < eventKinds; ++kind) json[key(EventKind(kind))] = events.total(EventKind(kind));
    return json;
}

/// Of those that happened.
nlohmann::ordered_json eventList(const EventCounts& events) {
    auto json = nlohmann::ordered_json::array();
    for (size_t s = 0; s < eventSources; ++s)
        for (size_t k = 0; k < eventKinds; ++k) {
            const auto source = EventSource(s);
            const auto kind = EventKind(k);
            if (const uint64_t count = events.at(source, kind); count > 0)
                json.push_back({{"source", key(source)}, {"kind", key(kind)}, {"count", count}});
        }
    return json;
}

/// "next event: 3 not finite, 1 negative; film: 1 negative".
std::string eventText(const EventCounts& events) {
    std::string text;
    for (size_t s = 0; s < eventSources; ++s) {
        std::vector<std::string> parts;
        for (size_t k = 0; k < eventKinds; ++k)
            if (const uint64_t count = events.at(EventSource(s), EventKind(k)); count > 0)
                parts.push_back(std::to_string(count) + " " + name(EventKind(k)));
        if (parts.empty()) continue;
        text += (text.empty() ? "" : "; ") + std::string(name(EventSource(s))) + ": " + joined(parts);
    }
    return text.empty() ? "none" : text;
}

}  // namespace

std::string statsJson(const RenderResult& result) {
    nlohmann::ordered_json json{
        {"sums_sha256", result.sums.imageAlone().sha256()},
        {"scene", result.scenePath},
        {"scene_hash", result.sceneHash},
        {"technique", result.settings.technique},
        {"precision", name(result.settings.precision)},
        {"sampler", name(result.settings.sampler)},
        {"iterations", result.sums.iterations},
        {"seed", result.settings.seed},
        {"width", result.sums.layout.width},
        {"height", result.sums.layout.height},
        {"initial_radius", result.statistics.initialRadius},
        {"final_radius", result.finalRadius},
        {"wall_seconds", result.wallSeconds},
        {"cpu_seconds", result.cpuSeconds},
        {"setup_seconds", result.setupSeconds},
        {"interrupted", result.interrupted},
        {"resumed_iterations", result.earlier.iterations},
        {"resumed_seconds", result.earlier.seconds},
        {"device", result.device},
        {"rays", result.totalRays()},
        {"shadow_rays", result.statistics.shadowRays},
        {"rays_per_second", result.raysPerSecond()},
        {"stages", nlohmann::ordered_json::array()},
        {"counters", counters(result.sums.events)},
        {"events", eventList(result.sums.events)},
        {"light_vertices", result.statistics.lightVertices},
        {"light_paths_per_iteration", result.statistics.lightPathsPerIteration},
        {"bvh_build_seconds", result.statistics.bvhBuildSeconds},
        {"bvh_primitives", result.statistics.bvhPrimitives},
        {"device_bytes", result.statistics.deviceBytes},
        {"peak_memory_bytes", peakMemoryBytes()},
        {"nodes", nlohmann::ordered_json::array()},
    };
    if (!result.settings.without.empty()) json["without"] = name(result.settings.without);
    if (result.choice) {
        json["choice"] = {{"reason", result.choice->reason}, {"measures", nlohmann::ordered_json::array()}};
        for (const CandidateMeasure& m : result.choice->measures)
            json["choice"]["measures"].push_back({{"technique", m.technique},
                                                  {"variance", m.variance},
                                                  {"trimmed_variance", m.trimmed},
                                                  {"seconds", m.seconds},
                                                  {"loses_light", m.losesLight}});
    }
    for (const PathClass& c : result.missing)
        json["missing"].push_back({{"paths", c.expression()}, {"words", c.words()}});
    json["stopped_by"] = key(result.stoppedBy);
    if (result.error) json["error"] = errorJson(*result.error);
    for (const NodeReport& node : result.nodes)
        json["nodes"].push_back({{"name", node.name},
                                 {"device", node.device},
                                 {"state", node.state},
                                 {"iterations", node.committed},
                                 {"results", node.results},
                                 {"lost_iterations", node.lost},
                                 {"iterations_per_second", node.iterationsPerSecond},
                                 {"bytes_received", node.bytesReceived},
                                 {"bytes_sent", node.bytesSent},
                                 {"connections", node.connections}});
    for (const StageTime& stage : result.statistics.stages)
        json["stages"].push_back({{"stage", stage.stage}, {"seconds", stage.seconds}, {"rays", stage.rays}});
    // A path need not be UTF-8; it must not cost the statistics.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

ImageMetadata imageMetadata(const RenderResult& result) {
    ImageMetadata metadata{
        {"antipode.scene", result.scenePath},
        {"antipode.sceneHash", result.sceneHash},
        {"antipode.jobHash", result.jobHash},
        {"antipode.technique", result.settings.technique},
        {"antipode.precision", name(result.settings.precision)},
        {"antipode.sampler", name(result.settings.sampler)},
        {"antipode.iterations", std::to_string(result.sums.iterations)},
        {"antipode.seed", std::to_string(result.settings.seed)},
        {"antipode.initialRadius", exact(result.statistics.initialRadius)},
        {"antipode.finalRadius", exact(result.finalRadius)},
        {"antipode.seconds", exact(result.earlier.seconds + result.wallSeconds)},
        {"antipode.device", result.device},
        {"antipode.sumsSha256", result.sums.imageAlone().sha256()},
        {"antipode.events", eventText(result.sums.events)},
    };
    if (!result.settings.without.empty()) metadata["antipode.without"] = name(result.settings.without);
    if (result.choice) metadata["antipode.choice"] = result.choice->reason;
    if (!result.missing.empty()) metadata["antipode.missing"] = described(result.missing);
    metadata["antipode.stoppedBy"] = key(result.stoppedBy);
    if (result.error) {
        metadata["antipode.errorPercent"] = exact(result.error->percent);
        metadata["antipode.errorLow"] = exact(result.error->low);
        metadata["antipode.errorHigh"] = exact(result.error->high);
        metadata["antipode.errorNoisePercent"] = exact(result.error->noisePercent);
        if (const auto& bias = result.error->bias) {
            metadata["antipode.errorBiasPercent"] = exact(bias->percent);
            metadata["antipode.errorBiasLow"] = exact(bias->low);
            metadata["antipode.errorBiasHigh"] = exact(bias->high);
        }
    }
    for (size_t k = 0; !hasErrorClasses(result.sums.layout) && k < result.sums.residueIterations.size(); ++k)
        metadata["antipode.residueIterations" + std::to_string(k)] = std::to_string(result.sums.residueIterations[k]);
    for (size_t kind = 0; kind < eventKinds; ++kind)
        metadata["antipode." + camelCase(key(EventKind(kind)))] =
            std::to_string(result.sums.events.total(EventKind(kind)));
    return metadata;
}

std::string outcomeJson(const RenderResult& result, const std::string& image) {
    nlohmann::ordered_json json{{"done", true},
                                {"iterations", result.sums.iterations},
                                {"seconds", result.wallSeconds},
                                {"stopped_by", key(result.stoppedBy)},
                                {"image", image}};
    if (result.error) json["error"] = errorJson(*result.error);
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string summary(const RenderResult& result) {
    std::ostringstream text;
    text << result.sums.layout.width << "x" << result.sums.layout.height << ", " << result.settings.technique
         << (result.settings.precision == Precision::Double ? ", double precision" : "") << ", "
         << result.sums.iterations << (result.sums.iterations == 1 ? " iteration" : " iterations")
         << (result.interrupted ? " (interrupted)" : "");
    if (result.earlier.iterations > 0) text << ", " << result.earlier.iterations << " of them from the checkpoint";
    if (result.sums.iterations == result.earlier.iterations) return text.str();
    text << " in " << duration(result.wallSeconds) << " (" << shortCount(result.iterationsPerSecond()) << " it/s, "
         << shortCount(result.raysPerSecond()) << " rays/s) on " << result.device;
    if (result.error) text << "; " << errorText(*result.error) << ", " << limitText(*result.error);
    if (result.sums.events.clean()) text << "; numerical events: none";
    if (const std::string doubt = result.error ? errorDoubt(*result.error) : ""; !doubt.empty()) text << "\n" << doubt;
    return text.str();
}

std::string eventWarning(const EventCounts& events) {
    return events.clean() ? "" : "the image is not trustworthy: " + eventText(events) + ".";
}

}  // namespace antipode
