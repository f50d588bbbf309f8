#include "client/study/study_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "client/study/fit.h"
#include "client/study/prices.h"
#include "renderengine/error.h"
#include "renderengine/pictures.h"

namespace antipode::study {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const std::vector<StageTime>& stages) {
    Json list = Json::array();
    for (const StageTime& stage : stages)
        list.push_back({{"stage", stage.stage}, {"seconds", stage.seconds}, {"rays", stage.rays}});
    return list;
}

Json toJson(const Interval& interval) {
    return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

std::string base64(const std::string& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string dataUrl(const std::string& png) { return "data:image/png;base64," + base64(png); }

/// One of the three clocks of a snapshot.
using Clock = double Snapshot::*;
constexpr std::pair<const char*, Clock> clocks[] = {
    {"wall", &Snapshot::wall}, {"cpu", &Snapshot::cpu}, {"device", &Snapshot::device}};
constexpr double targets[] = {20, 10, 5, 2, 1};

Json byClock(const VariantResult& result, const std::optional<Interval>& own, Clock clock) {
    const std::vector<Point> points = pointsOf(result, own, clock);
    const std::optional<PowerLaw> law = fitPowerLaw(points);
    Json json;
    if (law) json["slope"] = toJson(Interval{law->slope, law->slopeLow, law->slopeHigh}), json["scale"] = law->scale;
    for (const double target : targets) {
        const auto key = std::to_string(int(target));
        if (const auto time = timeTo(target, points, law))
            json["time_to"][key] = {{"seconds", time->seconds}, {"extrapolated", time->extrapolated}};
        else
            json["time_to"][key] = nullptr;
    }
    return json;
}

Json toJson(const VariantResult& result, const SceneResult& scene, bool pictures) {
    Json json{{"name", result.variant.name},
              {"label", result.variant.label},
              {"against", result.variant.against},
              {"is_technique", result.variant.technique},
              {"iterations", result.spent.iterations}};
    json["snapshots"] = Json::array();
    for (const Snapshot& snapshot : result.snapshots) {
        const Interval percent = percentOf(snapshot.errors);
        json["snapshots"].push_back({{"iterations", snapshot.iterations},
                                     {"wall", snapshot.wall},
                                     {"cpu", snapshot.cpu},
                                     {"device", snapshot.device},
                                     {"percent", percent.value},
                                     {"low", percent.low},
                                     {"high", percent.high},
                                     {"flip", snapshot.flip},
                                     {"non_finite", snapshot.errors.nonFinite},
                                     {"limited", limitedByReference(snapshot, scene.referencePercent)}});
    }
    for (const auto& [name, clock] : clocks) json["by"][name] = byClock(result, scene.referencePercent, clock);
    json["stages"] = toJson(result.spent.stages);
    if (pictures && result.spent.iterations > 0) {
        json["image"] = dataUrl(encodePng(result.image));
        json["map"] =
            dataUrl(encodeErrorMap(result.image.width, result.image.height,
                                   relativeErrors(result.image, scene.reference.image), errorMapLow, errorMapHigh));
    }
    return json;
}

}  // namespace

std::string encodeRecord(const RunRecord& record) {
    const Spent& spent = record.spent;
    Json json{{"device", record.device},
              {"iterations", spent.iterations},
              {"wall", spent.wall},
              {"cpu", spent.cpu},
              {"cpu_of_iterations", {spent.iterationCpu.count, spent.iterationCpu.sum, spent.iterationCpu.squares}},
              {"stages", toJson(spent.stages)},
              {"snapshots", Json::array()}};
    for (const Snapshot& s : record.snapshots)
        json["snapshots"].push_back({{"iterations", s.iterations},
                                     {"wall", s.wall},
                                     {"cpu", s.cpu},
                                     {"device", s.device},
                                     {"flip", s.flip},
                                     {"tiles", s.errors.relMse},
                                     {"shares", s.errors.share},
                                     {"reference", s.errors.referenceRelMse},
                                     {"non_finite", s.errors.nonFinite}});
    return json.dump();
}

RunRecord decodeRecord(const std::vector<uint8_t>& bytes, const std::string& path) {
    try {
        const Json json = Json::parse(bytes);
        RunRecord record;
        Spent& spent = record.spent;
        record.device = json.at("device");
        spent.iterations = json.at("iterations");
        spent.wall = json.at("wall");
        spent.cpu = json.at("cpu");
        const Json& each = json.at("cpu_of_iterations");
        spent.iterationCpu = {each.at(0), each.at(1), each.at(2)};
        for (const Json& stage : json.at("stages"))
            spent.stages.push_back({stage.at("stage"), stage.at("seconds"), stage.at("rays")});
        for (const Json& s : json.at("snapshots")) {
            Snapshot snapshot{s.at("iterations"), s.at("wall"), s.at("cpu"), s.at("device"), {}, s.at("flip")};
            snapshot.errors.relMse = s.at("tiles").get<std::vector<double>>();
            snapshot.errors.share = s.at("shares").get<std::vector<double>>();
            snapshot.errors.referenceRelMse = s.at("reference");
            snapshot.errors.nonFinite = s.at("non_finite");
            if (snapshot.errors.share.size() != snapshot.errors.relMse.size())
                throw Error(ErrorCode::Input, "'" + path + "' is no record of a study: remove it to begin anew.");
            record.snapshots.push_back(std::move(snapshot));
        }
        return record;
    } catch (const Json::exception&) {
        throw Error(ErrorCode::Input, "'" + path + "' is no record of a study: remove it to begin anew.");
    }
}

std::string studyCsv(const std::vector<SceneResult>& scenes) {
    std::string csv =
        "scene,variant,iterations,wall_seconds,cpu_seconds,device_seconds,percent,low,high,flip,non_finite,"
        "limited_by_reference\n";
    for (const SceneResult& scene : scenes)
        for (const VariantResult& result : scene.variants)
            for (const Snapshot& s : result.snapshots) {
                const Interval percent = percentOf(s.errors);
                char line[512];
                std::snprintf(line, sizeof line, ",%s,%llu,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%llu,%d\n",
                              result.variant.name.c_str(), static_cast<unsigned long long>(s.iterations), s.wall, s.cpu,
                              s.device, percent.value, percent.low, percent.high, s.flip,
                              static_cast<unsigned long long>(s.errors.nonFinite),
                              limitedByReference(s, scene.referencePercent));
                std::string name;  // quoted as RFC 4180 has it
                for (const char c : scene.name) name += c == '"' ? "\"\"" : std::string(1, c);
                csv += '"' + name + '"' + line;
            }
    return csv;
}

std::string studyJson(const std::vector<SceneResult>& scenes, bool pictures) {
    Json json{{"definition",
               "percent = 100 * sqrt(mean over pixels and channels of (x-ref)^2/(ref^2+0.01)), the reference's own "
               "variance taken off"},
              {"scenes", Json::array()}};
    for (const SceneResult& scene : scenes) {
        Json entry{{"name", scene.name},
                   {"device", scene.device},
                   {"width", scene.reference.image.width},
                   {"height", scene.reference.image.height},
                   {"reference", scene.referenceText}};
        entry["reference_percent"] = scene.referencePercent ? toJson(*scene.referencePercent) : Json();
        entry["variants"] = Json::array();
        for (const VariantResult& result : scene.variants) entry["variants"].push_back(toJson(result, scene, pictures));
        entry["prices"] = Json::array();
        for (const Price& price : prices(scene))
            entry["prices"].push_back({{"variant", price.variant},
                                       {"against", price.against},
                                       {"iterations", price.iterations},
                                       {"time_ratio", toJson(price.time)},
                                       {"error_ratio", toJson(price.error)},
                                       {"same_error_ratio", toJson(price.sameError)},
                                       {"sentence", sentence(price)}});
        if (pictures) entry["image"] = dataUrl(encodePng(scene.reference.image));
        json["scenes"].push_back(std::move(entry));
    }
    return json.dump(pictures ? -1 : 1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace antipode::study
