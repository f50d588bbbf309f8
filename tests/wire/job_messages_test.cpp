#include "proto/wire/job_messages.h"

#include <cmath>
#include <limits>

#include "renderengine/error.h"
#include "renderengine/io/text.h"
#include "renderengine/setting_fields.h"
#include "tests/film/expect_error.h"
#include "tests/wire/protocol_error.h"

namespace antipode::wire {
namespace {

using test::expectError;
using testing::expectProtocolError;

RenderSettings fullSettings() {
    RenderSettings s;
    s.width = 123;
    s.height = 45;
    s.crop = PixelWindow{3, 5, 100, 40};
    s.technique = "bpm";
    s.seed = 0xFEDCBA9876543210;
    s.initialRadius = 0.1;
    s.alpha = 0.75;
    s.maxPathLength = 17;
    s.russianRoulette = false;
    s.lightPathCount = 1000;
    s.connectionsPerVertex = 3;
    s.precision = Precision::Double;
    s.sampler = Sampler::Sobol;
    s.layers.add(LayerKind::Normal);
    s.guides = Guides::FirstHit;
    s.residueClasses = 8;
    return s;
}

/// Another value that an engine takes as well.
void change(uint32_t& v) { --v; }
void change(uint64_t& v) { --v; }
void change(double& v) { v *= 0.5; }
void change(PixelWindow& v) { --v.x0; }
void change(bool& v) { v = !v; }
void change(std::string& v) { v = "vcm"; }
void change(Precision& v) { v = Precision::Float; }
void change(Sampler& v) { v = Sampler::Independent; }
void change(Guides& v) { v = Guides::FirstDiffuse; }
void change(LayerSet& v) { v.add(LayerKind::Splat); }
void change(TransportSet& v) { v.add(Transport::Merging); }

/// Calls visit(row, settings) with settings of which that row's value was changed, for all rows that travel.
template <class Visit>
void withEachChanged(const Visit& visit) {
    RenderSettings rows;
    forEachField(rows, [&](auto row, auto&) {
        if constexpr (row.role == Reach::Job) {
            RenderSettings settings = fullSettings();
            forEachEntry(settings.*(row.member), [](auto& v) { change(v); });
            SCOPED_TRACE(row.name);
            visit(row, settings);
        }
    });
}

bool equal(const RenderSettings& a, const RenderSettings& b) {
    bool same = true;
    forEachField(a, [&](auto row, const auto& value) {
        if constexpr (row.role == Reach::Job) same &= value == b.*(row.member);
    });
    return same;
}

TEST(JobSettings, EveryFieldSurvives) {
    const std::string message = toMessage(fullSettings()).SerializeAsString(), hash = jobHash(fullSettings(), "s", "k");
    EXPECT_TRUE(equal(fromMessage(toMessage(fullSettings())), fullSettings()));
    int rows = 0;
    withEachChanged([&](auto, const RenderSettings& changed) {
        ++rows;
        EXPECT_FALSE(equal(changed, fullSettings()));
        EXPECT_TRUE(equal(fromMessage(toMessage(changed)), changed));
        EXPECT_NE(toMessage(changed).SerializeAsString(), message);
        EXPECT_NE(jobHash(changed, "s", "k"), hash);
    });
    EXPECT_EQ(rows, farm::JobSettings::descriptor()->field_count()) << "the message has fields without a row";
}

/// Checkpoints and hashes of jobs are made of these bytes; they were encoded by protoc.
TEST(JobSettings, BytesAreThoseOfEarlierBuilds) {
    RenderSettings earlier = fullSettings();
    earlier.sampler = Sampler::Independent;
    earlier.curvedTriangles = false;
    earlier.layers = {};
    earlier.guides = {};
    earlier.residueClasses.reset();
    earlier.crop.reset();
    EXPECT_EQ(hexadecimal(toMessage(earlier).SerializeAsString()),
              "087b102d1a0362706d2090e4d0b287d3aeeefe01299a9999999999b93f31000000000000e83f381148e80750035801");
}

TEST(JobSettings, NumbersOutsideTheirRangesAreNamed) {
    RenderSettings rows;
    int ranges = 0;
    forEachField(rows, [&](auto row, auto&) {
        using Value = Entry<decltype(rows.*(row.member))>;
        if constexpr (std::is_arithmetic_v<Value>) {
            if (row.range.greatest == std::numeric_limits<double>::infinity()) return;
            ++ranges;
            for (const double bad : {0.0, 2 * row.range.greatest}) {
                RenderSettings settings = fullSettings();
                settings.*(row.member) = Value(bad);
                expectError(ErrorCode::Usage, std::string(row.range.words) + " must be",
                            [&] { checkSettings(settings); });
            }
            if constexpr (std::is_floating_point_v<Value>) {
                RenderSettings settings = fullSettings();
                settings.*(row.member) = std::numeric_limits<Value>::quiet_NaN();
                expectError(ErrorCode::Usage, std::string(row.range.words) + " must be",
                            [&] { checkSettings(settings); });
            }
        }
    });
    EXPECT_GE(ranges, 8);
}

TEST(JobSettings, WhatIsNotSetStaysUnset) {
    RenderSettings s = fullSettings();
    s.maxPathLength.reset();
    s.lightPathCount.reset();
    s.russianRoulette = true;
    s.precision = Precision::Float;
    const RenderSettings back = fromMessage(toMessage(s));
    EXPECT_FALSE(back.maxPathLength);
    EXPECT_FALSE(back.lightPathCount);
    EXPECT_FALSE(back.single);
    EXPECT_FALSE(back.minPathLength);
    EXPECT_EQ(back.precision, Precision::Float);
}

TEST(JobSettings, EveryTechniqueIsTaken) {
    for (const TechniqueInfo& technique : techniqueTable()) {
        RenderSettings s = fullSettings();
        s.technique = technique.name;
        EXPECT_EQ(fromMessage(toMessage(s)).technique, technique.name);
    }
}

TEST(JobSettings, UnresolvedOnesAreNotSent) {
    const auto refuse = [](auto spoil) {
        RenderSettings s = fullSettings();
        spoil(s);
        expectError(ErrorCode::Usage, "needs its initial radius", [&] { toMessage(s); });
    };
    refuse([](RenderSettings& s) { s.initialRadius.reset(); });
    refuse([](RenderSettings& s) { s.single = SingleTechnique{}; });
    refuse([](RenderSettings& s) { s.minPathLength = 2; });
}

TEST(JobSettings, WhatNoEngineTakesIsRefused) {
    const auto refuse = [](const std::string& words, auto spoil) {
        farm::JobSettings m = toMessage(fullSettings());
        spoil(m);
        expectError(ErrorCode::Usage, words, [&] { fromMessage(m); });
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    refuse("width must be between 1 and 65536", [](auto& m) { m.set_width(0); });
    refuse("height must be between", [](auto& m) { m.set_height(0); });
    refuse("pixels", [](auto& m) { m.set_width(0x10000), m.set_height(0x10000); });
    refuse("must be between 1 and 65536", [](auto& m) { m.set_width(0xFFFFFFFF), m.set_height(0xFFFFFFFF); });
    refuse("the part to render, 3,5,124,40, is empty or reaches beyond the image of 123x45 pixels",
           [](auto& m) { m.mutable_crop()->set_x1(124); });
    refuse("part to render", [](auto& m) { m.mutable_crop()->set_y1(46); });
    refuse("part to render", [](auto& m) { m.mutable_crop()->set_x0(100); });
    refuse("part to render", [](auto& m) { m.mutable_crop()->Clear(); });
    refuse("technique", [](auto& m) { m.set_technique("rasterise"); });
    refuse("technique", [](auto& m) { m.clear_technique(); });
    for (const double radius : {0.0, -1.0, nan, inf}) refuse("radius", [&](auto& m) { m.set_initial_radius(radius); });
    for (const double alpha : {0.0, -0.5, 1.0001, nan, inf}) refuse("alpha", [&](auto& m) { m.set_alpha(alpha); });
    refuse("path length", [](auto& m) { m.set_max_path_length(65536); });
    refuse("Russian roulette", [](auto& m) { m.set_max_path_length(0); });
    refuse("connections", [](auto& m) { m.set_connections_per_vertex(0); });
    refuse("connections", [](auto& m) { m.set_connections_per_vertex(17); });
    refuse("precision", [](auto& m) { m.set_precision(farm::JobSettings::Precision(2)); });
    refuse("precision", [](auto& m) { m.set_precision(farm::JobSettings::Precision(-1)); });
    refuse("sampler", [](auto& m) { m.set_sampler(farm::JobSettings::Sampler(2)); });
    refuse("light paths", [](auto& m) { m.set_light_path_count((1 << 28) + 1); });
    refuse("light paths", [](auto& m) { m.set_light_path_count(std::numeric_limits<uint64_t>::max()); });
}

TEST(JobSettings, UnknownTechniquesAreNotRepeated) {
    farm::JobSettings m = toMessage(fullSettings());
    m.set_technique("\n2000-01-01 all is well");
    try {
        fromMessage(m);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find("well"), std::string::npos);
    }
}

TEST(Events, EverySourceAndKindSurvives) {
    EventCounts all;
    for (size_t s = 0; s < eventSources; ++s)
        for (size_t k = 0; k < eventKinds; ++k) {
            const uint64_t count = (1ull << 48) - (s * eventKinds + k);
            EventCounts one;
            one.at(EventSource(s), EventKind(k)) = all.at(EventSource(s), EventKind(k)) = count;
            const farm::EventCounts message = toMessage(one);
            EXPECT_EQ(message.entry_size(), 1);
            EXPECT_EQ(fromMessage(message), one) << name(EventSource(s)) << ", " << name(EventKind(k));
        }
    EXPECT_EQ(fromMessage(toMessage(all)), all);
    EXPECT_EQ(toMessage(EventCounts{}).entry_size(), 0);
    EXPECT_TRUE(fromMessage(farm::EventCounts{}).clean());
}

TEST(Events, WhatCannotHaveBeenCountedIsRefused) {
    EventCounts countless;
    countless.at(EventSource::Film, EventKind::Negative) = (1ull << 48) + 1;
    EXPECT_THROW(fromMessage(toMessage(countless)), ProtocolError);

    EventCounts valid;
    valid.at(EventSource::Film, EventKind::Negative) = 2;
    const auto refuse = [&](const std::string& words, auto spoil) {
        farm::EventCounts message = toMessage(valid);
        spoil(*message.mutable_entry(0));
        message.add_entry()->set_count(1);  // a valid one behind it
        expectProtocolError(words, [&] { fromMessage(message); });
    };
    refuse("does not know", [](auto& entry) { entry.set_source(eventSources); });
    refuse("does not know", [](auto& entry) { entry.set_source(0xFFFFFFFF); });
    refuse("does not know", [](auto& entry) { entry.set_kind(eventKinds); });
    refuse("does not know", [](auto& entry) { entry.set_kind(0xFFFFFFFF); });
    refuse("did not happen", [](auto& entry) { entry.set_count(0); });
    refuse("twice", [](auto& entry) { entry.set_source(0), entry.set_kind(0); });
}

TEST(Statistics, WhatAddsUpSurvives) {
    EngineStatistics statistics;
    statistics.stages = {{"light trace", 1.5, 10}, {"camera trace", 2.5, 20}};
    statistics.rays = 30, statistics.shadowRays = 40, statistics.lightVertices = 50;
    const EngineStatistics back = fromMessage(toMessage(statistics));
    ASSERT_EQ(back.stages.size(), 2u);
    EXPECT_EQ(back.stages[1].stage, "camera trace");
    EXPECT_EQ(back.stages[1].seconds, 2.5);
    EXPECT_EQ(back.stages[1].rays, 20u);
    EXPECT_EQ(back.rays, 30u);
    EXPECT_EQ(back.shadowRays, 40u);
    EXPECT_EQ(back.lightVertices, 50u);
}

TEST(Statistics, StagesThatNoEngineHasAreLeftOut) {
    farm::Statistics message;
    const auto add = [&](const std::string& name, double seconds) {
        message.add_stage()->set_stage(name);
        message.mutable_stage()->rbegin()->set_seconds(seconds);
    };
    add("negative", -1);
    add("not a number", std::numeric_limits<double>::quiet_NaN());
    add("infinite", std::numeric_limits<double>::infinity());
    add("two\nlines", 1);
    add(std::string(1000, 'x'), 1);
    add("good", 1);
    add("good", 2);
    const EngineStatistics statistics = fromMessage(message);
    ASSERT_EQ(statistics.stages.size(), 1u);
    EXPECT_EQ(statistics.stages[0].seconds, 3);
    for (int i = 0; i < 10000; ++i) add("stage " + std::to_string(i), 1);
    EXPECT_LT(fromMessage(message).stages.size(), 100u);
}

TEST(Statistics, Accumulate) {
    EngineStatistics total, part;
    part.stages = {{"a", 1, 2}, {"b", 3, 4}};
    part.rays = 5, part.shadowRays = 6, part.lightVertices = 7, part.deviceBytes = 8;
    accumulate(total, part);
    part.stages = {{"b", 1, 1}, {"c", 1, 1}};
    accumulate(total, part);
    ASSERT_EQ(total.stages.size(), 3u);
    EXPECT_EQ(total.stages[1].seconds, 4);
    EXPECT_EQ(total.stages[1].rays, 5u);
    EXPECT_EQ(total.rays, 10u);
    EXPECT_EQ(total.shadowRays, 12u);
    EXPECT_EQ(total.lightVertices, 14u);
    EXPECT_EQ(total.deviceBytes, 0u);
}

}  // namespace
}  // namespace antipode::wire
