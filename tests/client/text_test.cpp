#include "terminal/text.h"

#include <gtest/gtest.h>

#include "client/progress.h"
#include "renderengine/io/suggest.h"

using namespace antipode;

TEST(ClientText, CountsHaveThreeDigits) {
    EXPECT_EQ(shortCount(0), "0");
    EXPECT_EQ(shortCount(7), "7");
    EXPECT_EQ(shortCount(5.217), "5.22");
    EXPECT_EQ(shortCount(99.96), "100");
    EXPECT_EQ(shortCount(999.4), "999");
    EXPECT_EQ(shortCount(999.6), "1.00 k");
    EXPECT_EQ(shortCount(84123456), "84.1 M");
}

TEST(ClientText, DurationsCarry) {
    EXPECT_EQ(duration(0), "0.0 s");
    EXPECT_EQ(duration(59.94), "59.9 s");
    EXPECT_EQ(duration(59.96), "1:00");
    EXPECT_EQ(duration(3599.6), "1:00:00");
    EXPECT_EQ(duration(3723), "1:02:03");
}

TEST(ClientText, SizesHaveBinaryPrefixes) {
    EXPECT_EQ(byteSize(1023), "1023 B");
    EXPECT_EQ(byteSize(1536), "1.5 KiB");
    EXPECT_EQ(byteSize(uint64_t(80) << 30), "80.0 GiB");
}

TEST(ClientProgress, TellsRatesAndWhatIsLeft) {
    ProgressState state;
    state.iterations = 12;
    state.iterationLimit = 64;
    state.elapsedSeconds = 3;
    state.rays = 6000000;
    EXPECT_EQ(progressText(state), "12 of 64 iterations, 4 it/s, 2 M rays/s, 3.0 s, 13.0 s left");
    state.secondLimit = 5;
    EXPECT_EQ(progressText(state), "12 of 64 iterations, 4 it/s, 2 M rays/s, 3.0 s, 2.0 s left");
    state.iterationLimit.reset();
    state.secondLimit = 2;
    EXPECT_EQ(progressText(state), "12 iterations, 4 it/s, 2 M rays/s, 3.0 s, 0.0 s left");
}

TEST(ClientSuggest, FindsTheNearestNameOrNone) {
    const std::vector<std::string> names{"--width", "--height", "--iterations"};
    EXPECT_EQ(suggestion("--widht", names), " Did you mean '--width'?");
    EXPECT_EQ(suggestion("--heigth", names), " Did you mean '--height'?");
    EXPECT_EQ(suggestion("--iters", names), "");
    EXPECT_EQ(suggestion("--frobnicate", names), "");
    EXPECT_EQ(suggestion("", names), "");
    EXPECT_EQ(suggestion(std::string(100000, 'x'), names), "");
    EXPECT_EQ(suggestion("pbt", {"pt", "bpt"}), " Did you mean 'pt'?") << "the first of a tie";
}
