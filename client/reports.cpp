#include "client/reports.h"

#include <sstream>

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "client/terminal/suggest.h"
#include "client/terminal/text.h"

namespace antipode {
namespace {

uint64_t peakMemoryBytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return uint64_t(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

/// The shortest decimal text that reads back as the same double.
std::string exact(double value) { return nlohmann::json(value).dump(); }

}  // namespace

std::string statsJson(const RenderResult& result) {
    const FilmCounters& counters = result.sums.counters;
    nlohmann::ordered_json json{
        {"sums_sha256", result.sums.sha256()},
        {"scene", result.scenePath},
        {"scene_hash", result.sceneHash},
        {"technique", result.settings.technique},
        {"iterations", result.sums.iterations},
        {"seed", result.settings.seed},
        {"width", result.sums.width},
        {"height", result.sums.height},
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
        {"counters",
         {{"non_finite", counters.nonFinite},
          {"negative", counters.negative},
          {"saturated", counters.saturated},
          {"loop_limit", counters.loopLimit}}},
        {"light_vertices", result.statistics.lightVertices},
        {"light_paths_per_iteration", result.statistics.lightPathsPerIteration},
        {"bvh_build_seconds", result.statistics.bvhBuildSeconds},
        {"bvh_primitives", result.statistics.bvhPrimitives},
        {"device_bytes", result.statistics.deviceBytes},
        {"peak_memory_bytes", peakMemoryBytes()},
        {"nodes", nlohmann::ordered_json::array()},
    };
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
    const FilmCounters& counters = result.sums.counters;
    return {
        {"antipode.scene", result.scenePath},
        {"antipode.sceneHash", result.sceneHash},
        {"antipode.technique", result.settings.technique},
        {"antipode.iterations", std::to_string(result.sums.iterations)},
        {"antipode.seed", std::to_string(result.settings.seed)},
        {"antipode.initialRadius", exact(result.statistics.initialRadius)},
        {"antipode.finalRadius", exact(result.finalRadius)},
        {"antipode.seconds", exact(result.earlier.seconds + result.wallSeconds)},
        {"antipode.device", result.device},
        {"antipode.sumsSha256", result.sums.sha256()},
        {"antipode.nonFinite", std::to_string(counters.nonFinite)},
        {"antipode.negative", std::to_string(counters.negative)},
        {"antipode.saturated", std::to_string(counters.saturated)},
        {"antipode.loopLimit", std::to_string(counters.loopLimit)},
    };
}

std::string summary(const RenderResult& result) {
    std::ostringstream text;
    text << result.sums.width << "x" << result.sums.height << ", " << result.settings.technique << ", "
         << result.sums.iterations << (result.sums.iterations == 1 ? " iteration" : " iterations")
         << (result.interrupted ? " (interrupted)" : "");
    if (result.earlier.iterations > 0) text << ", " << result.earlier.iterations << " of them from the checkpoint";
    if (result.sums.iterations == result.earlier.iterations) return text.str();
    text << " in " << duration(result.wallSeconds) << " (" << shortCount(result.iterationsPerSecond()) << " it/s, "
         << shortCount(result.raysPerSecond()) << " rays/s) on " << result.device;
    return text.str();
}

std::string counterWarning(const FilmCounters& counters) {
    if (counters.clean()) return "";
    std::vector<std::string> parts;
    const auto add = [&](uint64_t count, const char* what) {
        if (count > 0) parts.push_back(std::to_string(count) + " " + what);
    };
    add(counters.nonFinite, "not finite");
    add(counters.negative, "negative");
    add(counters.saturated, "too large for the film");
    add(counters.loopLimit, "from a loop that was cut short");
    return "the image is not trustworthy: of its samples, " + joined(parts) + ".";
}

}  // namespace antipode
