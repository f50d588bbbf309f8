#include "proto/wire/loop_watch.h"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace antipode::wire {
namespace {

TEST(LoopWatch, TellsWhatTookLongerThanFiftyMilliseconds) {
    double now = 7;
    std::vector<std::string> told;
    const LoopWatch watch([&](const std::string& sentence) { told.push_back(sentence); }, [&] { return now; });
    const auto take = [&](double seconds) { watch.run([] { return "somebody"; }, [&] { now += seconds; }); };
    take(0.049);
    EXPECT_TRUE(told.empty());
    take(0.120);
    EXPECT_EQ(told, std::vector<std::string>{"somebody blocked the event loop for 120 ms"});
    const auto fail = [&] {
        now += 1;
        throw std::runtime_error("in vain");
    };
    EXPECT_THROW(watch.run([] { return "another"; }, fail), std::runtime_error);
    EXPECT_EQ(told.back(), "another blocked the event loop for 1000 ms");
}

TEST(LoopWatch, WatchesNothingUnlessTold) {
    bool ran = false;
    LoopWatch().run([]() -> std::string { throw std::logic_error("nobody asks"); }, [&] { ran = true; });
    EXPECT_TRUE(ran);
}

}  // namespace
}  // namespace antipode::wire
