#include "proto/wire/job_messages.h"

#include <algorithm>
#include <cstdlib>

#include "renderengine/sha256.h"
#include "proto/wire/frame.h"
#include "renderengine/error.h"
#include "renderengine/setting_fields.h"
#include "renderengine/io/text.h"

namespace antipode::wire {
namespace {

void require(bool holds, const std::string& sentence) {
    if (!holds) throw Error(ErrorCode::Usage, sentence);
}

bool isKnown(const std::string& technique) {
    return std::ranges::any_of(techniqueTable(), [&](const TechniqueInfo& info) { return info.name == technique; });
}

static_assert(int(Precision::Float) == farm::JobSettings::FLOAT && int(Precision::Double) == farm::JobSettings::DOUBLE);
static_assert(int(Sampler::Independent) == farm::JobSettings::INDEPENDENT &&
              int(Sampler::Sobol) == farm::JobSettings::SOBOL);
static_assert(int(Guides::FirstDiffuse) == farm::JobSettings::FIRST_DIFFUSE &&
              int(Guides::FirstHit) == farm::JobSettings::FIRST_HIT);

template <class V>
constexpr bool isSet = false;
template <class E, uint32_t size>
constexpr bool isSet<EnumSet<E, size>> = true;

/// Sets the field of that name.
template <class V>
void write(const V& v, const char* name, farm::JobSettings& message) {
    const auto& reflection = *message.GetReflection();
    const auto* field = message.GetDescriptor()->FindFieldByName(name);
    if constexpr (std::is_same_v<V, uint32_t>) reflection.SetUInt32(&message, field, v);
    if constexpr (std::is_same_v<V, uint64_t>) reflection.SetUInt64(&message, field, v);
    if constexpr (std::is_same_v<V, double>) reflection.SetDouble(&message, field, v);
    if constexpr (std::is_same_v<V, bool>) reflection.SetBool(&message, field, v);
    if constexpr (std::is_same_v<V, std::string>) reflection.SetString(&message, field, v);
    if constexpr (isSet<V>) reflection.SetUInt32(&message, field, v.bits());
    if constexpr (std::is_enum_v<V>) reflection.SetEnumValue(&message, field, int(v));
    if constexpr (std::is_same_v<V, PixelWindow>) {
        auto& window = dynamic_cast<farm::JobSettings::PixelWindow&>(*reflection.MutableMessage(&message, field));
        window.set_x0(v.x0);
        window.set_y0(v.y0);
        window.set_x1(v.x1);
        window.set_y1(v.y1);
    }
}

template <class V>
void read(const farm::JobSettings& message, const char* name, V& v) {
    const auto& reflection = *message.GetReflection();
    const auto* field = message.GetDescriptor()->FindFieldByName(name);
    if constexpr (std::is_same_v<V, uint32_t>) v = reflection.GetUInt32(message, field);
    if constexpr (std::is_same_v<V, uint64_t>) v = reflection.GetUInt64(message, field);
    if constexpr (std::is_same_v<V, double>) v = reflection.GetDouble(message, field);
    if constexpr (std::is_same_v<V, bool>) v = reflection.GetBool(message, field);
    if constexpr (std::is_same_v<V, std::string>) v = reflection.GetString(message, field);
    if constexpr (isSet<V>) {
        v = V(reflection.GetUInt32(message, field));
        require(v.bits() >> V::size == 0, "the job's " + field->name() + " names what this build does not have");
    }
    if constexpr (std::is_enum_v<V>) {
        const int number = reflection.GetEnumValue(message, field);
        require(field->enum_type()->FindValueByNumber(number),
                "the job asks for a " + field->name() + " that this build does not have");
        v = V(number);
    }
    if constexpr (std::is_same_v<V, std::optional<PixelWindow>>) {
        if (!reflection.HasField(message, field)) return;
        const auto& window = dynamic_cast<const farm::JobSettings::PixelWindow&>(reflection.GetMessage(message, field));
        v = PixelWindow{window.x0(), window.y0(), window.x1(), window.y1()};
    } else if constexpr (isOptional<V>) {  // of which 0 stands for nothing
        typename V::value_type number{};
        read(message, name, number);
        if (number != 0) v = number;
    }
}

/// More than any engine has: what a peer sends must not grow a job's statistics without end.
constexpr size_t maxStages = 32, maxStageName = 64;
constexpr double maxStageSeconds = 1e9;
constexpr int32_t maxScaleExponent = 1023;  // of a double

/// Adds to the stage of that name, which may be a new one.
void addStage(EngineStatistics& statistics, const StageTime& part) {
    for (StageTime& stage : statistics.stages) {
        if (stage.stage != part.stage) continue;
        stage.seconds += part.seconds;
        stage.rays += part.rays;
        return;
    }
    if (statistics.stages.size() < maxStages) statistics.stages.push_back(part);
}

bool isStage(const farm::StageTime& stage) {
    return stage.stage().size() <= maxStageName &&
           std::ranges::all_of(stage.stage(), [](char c) { return c >= ' ' && c <= '~'; }) && stage.seconds() >= 0 &&
           stage.seconds() <= maxStageSeconds;
}

}  // namespace

farm::JobSettings toMessage(const RenderSettings& settings) {
    require(
        settings.initialRadius.has_value() && !settings.single && !settings.minPathLength,
        "a job for other machines needs its initial radius, and neither a single technique nor a least path length");
    farm::JobSettings message;
    forEachField(settings, [&](auto setting, const auto& value) {
        if constexpr (setting.role == Reach::Job)
            forEachEntry(value, [&](const auto& v) { write(v, setting.name, message); });
    });
    return message;
}

RenderSettings fromMessage(const farm::JobSettings& message) {
    // checkSettings() would repeat the name, which here may be anything, in its sentence.
    require(isKnown(message.technique()), "the job asks for a technique that this build does not have");
    RenderSettings settings;
    forEachField(settings, [&](auto setting, auto& value) {
        if constexpr (setting.role == Reach::Job) read(message, setting.name, value);
    });
    require(settings.initialRadius.has_value(), "the job has no initial radius");
    checkSettings(settings);
    return settings;
}

std::string jobHash(const RenderSettings& settings, const std::string& sceneHash, const std::string& kernelHash) {
    // Messages without maps are written in the order of their fields' numbers. No hash holds an end of line.
    return hexadecimal(sha256Of(sceneHash + "\n" + kernelHash + "\n" + toMessage(settings).SerializeAsString()));
}

farm::OpenJob makeOpenJob(const std::string& job, const RenderSettings& settings, const farm::BlobRef& scene,
                          const std::string& sceneHash, const std::string& kernelHash) {
    farm::OpenJob open;
    open.set_job(job);
    *open.mutable_settings() = toMessage(settings);
    *open.mutable_scene() = scene;
    open.set_scene_hash(sceneHash);
    open.set_job_hash(jobHash(settings, sceneHash, kernelHash));
    return open;
}

FilmLayout layoutOf(const RenderSettings& settings, const google::protobuf::RepeatedField<int32_t>& scaleExponents) {
    FilmLayout layout = filmLayout(settings);
    if (size_t(scaleExponents.size()) != layout.layers.size())
        throw ProtocolError("a film has other layers than the job calls for");
    for (int i = 0; i < scaleExponents.size(); ++i) {
        if (std::abs(int64_t(scaleExponents[i])) > maxScaleExponent)
            throw ProtocolError("a film's scale is out of range");
        layout.layers[size_t(i)].scaleExponent = scaleExponents[i];
    }
    return layout;
}

farm::EventCounts toMessage(const EventCounts& events) {
    farm::EventCounts message;
    for (uint32_t source = 0; source < eventSources; ++source)
        for (uint32_t kind = 0; kind < eventKinds; ++kind) {
            const uint64_t count = events.at(EventSource(source), EventKind(kind));
            if (count == 0) continue;
            farm::EventCounts::Entry* entry = message.add_entry();
            entry->set_source(source);
            entry->set_kind(kind);
            entry->set_count(count);
        }
    return message;
}

EventCounts fromMessage(const farm::EventCounts& message) {
    EventCounts events;
    for (const farm::EventCounts::Entry& entry : message.entry()) {
        if (entry.source() >= eventSources || entry.kind() >= eventKinds)
            throw ProtocolError("events are counted that this build does not know");
        uint64_t& count = events.at(EventSource(entry.source()), EventKind(entry.kind()));
        if (entry.count() == 0) throw ProtocolError("events are counted that did not happen");
        // So that no number of results adds up to 0.
        if (entry.count() > (1ull << 48)) throw ProtocolError("more events are counted than a block can have");
        if (count != 0) throw ProtocolError("events are counted twice");
        count = entry.count();
    }
    return events;
}

farm::Statistics toMessage(const EngineStatistics& statistics) {
    farm::Statistics message;
    for (const StageTime& from : statistics.stages) {
        farm::StageTime* stage = message.add_stage();
        stage->set_stage(from.stage);
        stage->set_seconds(from.seconds);
        stage->set_rays(from.rays);
    }
    message.set_rays(statistics.rays);
    message.set_shadow_rays(statistics.shadowRays);
    message.set_light_vertices(statistics.lightVertices);
    return message;
}

EngineStatistics fromMessage(const farm::Statistics& message) {
    EngineStatistics statistics;
    for (const farm::StageTime& stage : message.stage())
        if (isStage(stage)) addStage(statistics, {stage.stage(), stage.seconds(), stage.rays()});
    statistics.rays = message.rays();
    statistics.shadowRays = message.shadow_rays();
    statistics.lightVertices = message.light_vertices();
    return statistics;
}

void accumulate(EngineStatistics& total, const EngineStatistics& part) {
    for (const StageTime& stage : part.stages) addStage(total, stage);
    total.rays += part.rays;
    total.shadowRays += part.shadowRays;
    total.lightVertices += part.lightVertices;
}

}  // namespace antipode::wire
