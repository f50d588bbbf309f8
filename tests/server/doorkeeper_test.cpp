#include "server/doorkeeper.h"

#include <gtest/gtest.h>

#include "server/log_throttle.h"

namespace antipode::test {
namespace {

TEST(Doorkeeper, OneAddressCannotConnectWithoutEnd) {
    Doorkeeper door;
    int admitted = 0;
    for (int i = 0; i < 27620; ++i) admitted += door.admits("192.0.2.7", 100 + i / 2762.0);
    EXPECT_NEAR(admitted, Doorkeeper::burst + 10 * Doorkeeper::perSecond, 2);
    door.admits("192.0.2.7", 110);
    EXPECT_FALSE(door.admits("192.0.2.7", 110));
    EXPECT_TRUE(door.admits("198.51.100.1", 110)) << "another one is not concerned";
    EXPECT_TRUE(door.admits("192.0.2.7", 111));
}

TEST(Doorkeeper, RemembersABoundedNumberOfAddresses) {
    Doorkeeper door;
    for (int i = 0; i < 100000; ++i) door.admits("2001:db8::" + std::to_string(i), 100);
    EXPECT_LE(door.known(), 4096u);
    EXPECT_FALSE(door.admits("2001:db8::1:0", 100)) << "those that do not fit in share one budget";
    EXPECT_TRUE(door.admits("2001:db8::1:0", 200)) << "those that kept quiet are forgotten";
    EXPECT_LE(door.known(), 1u);
}

TEST(Doorkeeper, TheOldestOfTheMostFrequentAddressGoes) {
    EXPECT_EQ(whoGoes({"a"}), 0u);
    EXPECT_EQ(whoGoes({"far", "flood", "flood", "near"}), 1u);
    EXPECT_EQ(whoGoes({"far", "flood", "near", "near", "flood", "flood"}), 1u);
}

TEST(LogThrottle, WritesSoManyLinesAndCountsTheRest) {
    std::vector<std::string> log;
    LogThrottle throttle([&](const std::string& line) { log.push_back(line); }, 3);
    for (int i = 0; i < 1000; ++i) throttle.say("not let in", 100 + i * 0.01);
    EXPECT_EQ(log.size(), 3u);
    throttle.tick(159);
    EXPECT_EQ(log.size(), 3u);
    throttle.tick(161);
    EXPECT_EQ(log.back(), "997 more lines like that within the last minute");
    throttle.say("again", 162);
    EXPECT_EQ(log.back(), "again");
    throttle.tick(300);
    EXPECT_EQ(log.back(), "again") << "nothing was left out";
}

}  // namespace
}  // namespace antipode::test
