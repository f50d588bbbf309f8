#include "client/live_state.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace antipode;

namespace {

LiveState stateOf(uint64_t iterations, double seconds) {
    LiveState state;
    state.progress.emplace();
    state.progress->iterations = iterations;
    state.progress->elapsedSeconds = seconds;
    return state;
}

}  // namespace

TEST(LiveState, GoesTowardsItsFirstLimit) {
    LiveState state = stateOf(10, 30);
    EXPECT_EQ(shareDone(LiveState()), 0);
    EXPECT_EQ(shareDone(state), 0) << "no limit";
    state.progress->iterationLimit = 40;
    state.progress->iterationsInHand = 2;
    EXPECT_EQ(shareDone(state), 0.3);
    state.progress->secondLimit = 60;
    EXPECT_EQ(shareDone(state), 0.5);
    state.costs = {{2, false, ErrorForecastSeconds{2, 1, 0.1}}, {1, true, ErrorForecastSeconds{1, 10, 1}}};
    EXPECT_EQ(shareDone(state), 0.75) << "the error that was asked for comes in 10 s, after 40 in all";
    state.progress->elapsedSeconds = 90;
    EXPECT_EQ(shareDone(state), 1);
    state.progress.reset();
    state.done = true;
    EXPECT_EQ(shareDone(state), 1);
}

TEST(LiveState, IsOneLineThatTellsWhatIsKnownAndNothingElse) {
    LiveState state;
    state.scene = "pool\n.textproto \xff";
    state.phase = "reading";
    const std::string early = liveStateJson(state);
    EXPECT_EQ(early.find('\n'), std::string::npos);
    const auto json = nlohmann::json::parse(early);
    EXPECT_EQ(json["phase"], "reading");
    for (const char* absent : {"error", "history", "costs", "nodes", "stages", "techniques", "exposure", "iterations"})
        EXPECT_FALSE(json.contains(absent)) << absent;
}

TEST(LiveState, TellsOfErrorCostsNodesStagesAndTechniques) {
    LiveState state = stateOf(16, 2);
    ErrorEstimate error;
    error.percent = 3;
    error.low = 2.5;
    error.high = 3.5;
    error.tailIndex = std::numeric_limits<double>::infinity();
    state.progress->error = error;
    state.history = {{1, 8, 4.2, 4, 5}, {2, 16, 3, 2.5, 3.5}};
    state.costs = {{2, false, ErrorForecastSeconds{2, 2.5, 0.5}}, {1, true, std::nullopt}};
    NodeReport node;
    node.name = "local";
    node.committed = 16;
    node.lost = 3;
    state.nodes = {node};
    state.stages = {{"merge", 1.5, 0}, {"connect", 0.5, 77}};
    state.techniques.add(LayerKind::Merge);
    state.techniques.add(LayerKind::Albedo);
    const auto json = nlohmann::json::parse(liveStateJson(state));
    EXPECT_EQ(json["error"]["percent"], 3);
    EXPECT_EQ(json["limit"], "limited by noise");
    EXPECT_EQ(json["history"].dump(), "[[1.0,8,4.2,4.0,5.0],[2.0,16,3.0,2.5,3.5]]");
    EXPECT_EQ(json["costs"].dump(),
              R"([{"asked":false,"percent":2.0,"seconds":2.5,"spread":0.5},{"asked":true,"percent":1.0}])");
    EXPECT_EQ(json["nodes"][0]["lost"], 3);
    EXPECT_EQ(json["stages"][1]["rays"], 77);
    ASSERT_EQ(json["techniques"].size(), 1u) << "guides are no technique";
    EXPECT_EQ(json["techniques"][0]["bit"], 8);
    EXPECT_EQ(json["techniques"][0]["name"], "merge");
}
