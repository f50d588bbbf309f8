// What a render says about events and precision, in each of its reports.
#include "client/reports.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace antipode;

namespace {

RenderResult cleanResult() {
    RenderResult result;
    result.settings.technique = "bpt";
    result.sums = {{2, 1, {{LayerKind::Image, "", "RGB", 20}}}, 4, std::vector<int64_t>(6), {}};
    result.device = "device";
    result.wallSeconds = 1;
    return result;
}

RenderResult eventfulResult() {
    RenderResult result = cleanResult();
    EventCounts& events = result.sums.events;
    events.at(EventSource::NextEvent, EventKind::NonFinite) = 3;
    events.at(EventSource::NextEvent, EventKind::ZeroPdf) = 20;
    events.at(EventSource::CameraTrace, EventKind::LoopLimit) = 1;
    events.at(EventSource::Film, EventKind::NonFinite) = 4;
    return result;
}

const std::string eventfulText =
    "next event: 3 not finite, 20 drawn with zero density; camera trace: 1 from a loop that was cut short; "
    "film: 4 not finite";

}  // namespace

TEST(Reports, StatisticsCountEachKindAndListWhatHappened) {
    const auto stats = nlohmann::json::parse(statsJson(eventfulResult()));
    EXPECT_EQ(stats["counters"], (nlohmann::json{{"non_finite", 7},
                                                 {"negative", 0},
                                                 {"zero_pdf", 20},
                                                 {"saturated", 0},
                                                 {"loop_limit", 1},
                                                 {"stack_overflow", 0},
                                                 {"sum_overflow", 0}}));
    EXPECT_EQ(stats["events"], nlohmann::json::parse(R"([
        {"source": "next_event", "kind": "non_finite", "count": 3},
        {"source": "next_event", "kind": "zero_pdf", "count": 20},
        {"source": "camera_trace", "kind": "loop_limit", "count": 1},
        {"source": "film", "kind": "non_finite", "count": 4}])"));
    EXPECT_EQ(nlohmann::json::parse(statsJson(cleanResult()))["events"], nlohmann::json::array());
}

TEST(Reports, TheImageSaysWhatHappenedInIt) {
    ImageMetadata metadata = imageMetadata(eventfulResult());
    EXPECT_EQ(metadata["antipode.nonFinite"], "7");
    EXPECT_EQ(metadata["antipode.negative"], "0");
    EXPECT_EQ(metadata["antipode.zeroPdf"], "20");
    EXPECT_EQ(metadata["antipode.saturated"], "0");
    EXPECT_EQ(metadata["antipode.loopLimit"], "1");
    EXPECT_EQ(metadata["antipode.stackOverflow"], "0");
    EXPECT_EQ(metadata["antipode.sumOverflow"], "0");
    EXPECT_EQ(metadata["antipode.events"], eventfulText);
    EXPECT_EQ(imageMetadata(cleanResult())["antipode.events"], "none");
}

TEST(Reports, AWarningSaysWhere) {
    EXPECT_EQ(eventWarning(eventfulResult().sums.events), "the image is not trustworthy: " + eventfulText + ".");
    EXPECT_EQ(eventWarning(cleanResult().sums.events), "");
}

TEST(Reports, TheSummarySaysThatTheEventsWereCounted) {
    EXPECT_TRUE(summary(cleanResult()).ends_with("; numerical events: none")) << summary(cleanResult());
    EXPECT_EQ(summary(eventfulResult()).find("events"), std::string::npos) << "the warning tells them";
}

TEST(Reports, EachTellsTheErrorAndWhyItStopped) {
    RenderResult result = cleanResult();
    EXPECT_FALSE(nlohmann::json::parse(statsJson(result)).contains("error"));
    EXPECT_EQ(imageMetadata(result).count("antipode.errorPercent"), 0u);
    result.error = ErrorEstimate{4, 1.84, 1.72, 1.96, 0.25, 0.125, 0.5, 0, 1.84};
    result.stoppedBy = StopReason::Time;
    const auto stats = nlohmann::json::parse(statsJson(result));
    EXPECT_EQ(stats["error"], (nlohmann::json{{"percent", 1.84},
                                              {"low", 1.72},
                                              {"high", 1.96},
                                              {"noise_percent", 1.84},
                                              {"worst_share", 0.25},
                                              {"half_share", 0.125},
                                              {"limited_by", "noise"},
                                              {"tail_index", 0.5}}));
    EXPECT_EQ(stats["stopped_by"], "time");
    EXPECT_EQ(imageMetadata(result)["antipode.errorPercent"], "1.84");
    EXPECT_EQ(imageMetadata(result)["antipode.errorHigh"], "1.96");
    EXPECT_EQ(imageMetadata(result)["antipode.stoppedBy"], "time");
    EXPECT_NE(summary(result).find("; 1.8 % error (1.7 to 2), limited by noise"), std::string::npos) << summary(result);
    EXPECT_EQ(summary(result).find('\n'), std::string::npos);
    result.error->tailIndex = 1.5;
    EXPECT_NE(summary(result).find("\nthe error may be larger than told"), std::string::npos) << summary(result);
}

TEST(Reports, EachTellsNoiseAndBiasApart) {
    RenderResult result = cleanResult();
    result.error = ErrorEstimate{4, 2.5, 2.3, 2.75, 0.25, 0.125, 0.5, 0, 2, MergeBias{1.5, 1.25, 1.75}};
    const auto error = nlohmann::json::parse(statsJson(result))["error"];
    EXPECT_EQ(error["percent"], 2.5);
    EXPECT_EQ(error["noise_percent"], 2);
    EXPECT_EQ(error["bias_percent"], 1.5);
    EXPECT_EQ(error["bias_low"], 1.25);
    EXPECT_EQ(error["bias_high"], 1.75);
    EXPECT_EQ(error["limited_by"], "noise");
    EXPECT_EQ(imageMetadata(result)["antipode.errorNoisePercent"], "2.0");
    EXPECT_EQ(imageMetadata(result)["antipode.errorBiasPercent"], "1.5");
    EXPECT_EQ(imageMetadata(result)["antipode.errorBiasHigh"], "1.75");
    EXPECT_NE(summary(result).find("2.5 % error (2.3 to 2.8), limited by noise, merge blur 1.5 %"), std::string::npos)
        << summary(result);
    result.error->bias = MergeBias{0.2, 0, 1.75};
    EXPECT_NE(summary(result).find("limited by noise, merge blur below 1.8 %"), std::string::npos) << summary(result);
    result.error->bias = MergeBias{0.2, 0, 2.5};
    EXPECT_NE(summary(result).find("limited by noise; "), std::string::npos) << "nothing is known of it";
    result.error->bias = MergeBias{3, 2.5, 3.5};
    EXPECT_NE(summary(result).find("limited by merge blur, 3 % with 2 % of noise"), std::string::npos)
        << summary(result);
    EXPECT_EQ(nlohmann::json::parse(statsJson(result))["error"]["limited_by"], "merge-blur");
}

TEST(Reports, EachTellsThePrecision) {
    RenderResult result = cleanResult();
    EXPECT_EQ(nlohmann::json::parse(statsJson(result))["precision"], "float");
    EXPECT_EQ(imageMetadata(result)["antipode.precision"], "float");
    EXPECT_TRUE(summary(result).starts_with("2x1, bpt, 4 iterations in 1.0 s (")) << summary(result);
    result.settings.precision = Precision::Double;
    EXPECT_EQ(nlohmann::json::parse(statsJson(result))["precision"], "double");
    EXPECT_EQ(imageMetadata(result)["antipode.precision"], "double");
    EXPECT_TRUE(summary(result).starts_with("2x1, bpt, double precision, 4 iterations in 1.0 s ("));
}
