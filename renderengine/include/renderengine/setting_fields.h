// The render settings, by the names that they have in job messages (farm.JobSettings in proto/farm.proto). Job messages
// and with them hashes of jobs and checkpoints, the comparison of jobs, and checkSettings() walk this table: a new
// setting is a member in settings.h, a row here and a field in the message.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "renderengine/field_table.h"
#include "renderengine/settings.h"

namespace antipode {

/// How far a setting gets.
enum class Reach {
    Job,   ///< decides the image's bytes: sent, hashed and kept; the message has 0 for what is not set
    Here,  ///< resolved before a job is sent, or for tests, which send none
};

/// What people call the setting, and what its number may be. No NaN is in a range.
struct SettingRange {
    std::string_view words;
    double least = -std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::infinity();

    bool holds(double v) const { return v >= least && v <= greatest; }
};

template <Reach reach, class V>
constexpr Field<reach, RenderSettings, V, SettingRange> setting(const char* name, V RenderSettings::*member,
                                                                SettingRange range) {
    return {name, member, range};
}

constexpr auto fieldsOf(Of<RenderSettings>) {
    using S = RenderSettings;
    using Most = SettingsLimits;
    constexpr double aboveZero = std::numeric_limits<double>::denorm_min(), finite = std::numeric_limits<double>::max();
    return std::tuple{
        setting<Reach::Job>("width", &S::width, {"width", 1, Most::side}),
        setting<Reach::Job>("height", &S::height, {"height", 1, Most::side}),
        setting<Reach::Job>("crop", &S::crop, {"part to render"}),
        setting<Reach::Job>("technique", &S::technique, {"technique"}),
        setting<Reach::Here>("single", &S::single, {"single technique"}),
        setting<Reach::Job>("without", &S::without, {"set of what is left out"}),
        setting<Reach::Job>("seed", &S::seed, {"seed"}),
        setting<Reach::Here>("radius_factor", &S::radiusFactor, {"radius factor", aboveZero, finite}),
        setting<Reach::Job>("initial_radius", &S::initialRadius, {"initial radius", aboveZero, finite}),
        setting<Reach::Job>("alpha", &S::alpha, {"alpha", aboveZero, 1}),
        setting<Reach::Here>("min_path_length", &S::minPathLength, {"least path length"}),
        setting<Reach::Job>("max_path_length", &S::maxPathLength, {"greatest path length", 1, Most::pathLength}),
        setting<Reach::Job>("russian_roulette", &S::russianRoulette, {"Russian roulette"}),
        setting<Reach::Job>("light_path_count", &S::lightPathCount, {"number of light paths", 1, Most::lightPaths}),
        setting<Reach::Job>("connections_per_vertex", &S::connectionsPerVertex,
                            {"number of connections per vertex", 1, Most::connectionsPerVertex}),
        setting<Reach::Job>("precision", &S::precision, {"precision"}),
        setting<Reach::Job>("sampler", &S::sampler, {"sampler"}),
        setting<Reach::Job>("curved_triangles", &S::curvedTriangles, {"curving of triangles"}),
        setting<Reach::Job>("layers", &S::layers, {"set of layers"}),
        setting<Reach::Job>("guides", &S::guides, {"kind of guides"}),
        setting<Reach::Job>("residue_classes", &S::residueClasses,
                            {"number of residue classes", 1, Most::residueClasses}),
    };
}

/// The range in the setting's row.
template <class V>
constexpr SettingRange rangeOf(V RenderSettings::*member) {
    SettingRange range;
    const auto look = [&](const auto& field) {
        if constexpr (std::is_same_v<decltype(field.member), V RenderSettings::*>)
            if (field.member == member) range = field.range;
    };
    std::apply([&](const auto&... field) { (look(field), ...); }, fieldsOf(Of<RenderSettings>{}));
    return range;
}

}  // namespace antipode
