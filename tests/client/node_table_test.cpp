#include "client/node_table.h"

#include <gtest/gtest.h>

using namespace antipode;

namespace {

NodeReport node(const std::string& name, const std::string& state, uint64_t committed, uint64_t received) {
    NodeReport report;
    report.name = name;
    report.state = state;
    report.device = "device";
    report.iterationsPerSecond = 2.5;
    report.leases = 2;
    report.committed = committed;
    report.bytesReceived = received;
    return report;
}

}  // namespace

TEST(NodeTable, SharesAreOfWhatIsCommitted) {
    NodeRates rates;
    const auto lines = nodeTable({node("a:1", "rendering", 3, 0), node("b:1", "idle", 1, 0)}, rates, 1, 100);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_NE(lines[1].find("75 %"), std::string::npos) << lines[1];
    EXPECT_NE(lines[2].find("25 %"), std::string::npos) << lines[2];
    EXPECT_EQ(lines[0].size(), lines[1].size());
    EXPECT_EQ(lines[1].size(), lines[2].size());
}

TEST(NodeTable, TrafficIsSmoothed) {
    NodeRates rates;
    std::vector<std::string> lines;
    // 10 MB in each second, at its beginning.
    for (int i = 0; i <= 200; ++i)
        lines = nodeTable({node("a:1", "rendering", 1, uint64_t(i / 4) * 10000000)}, rates, i * 0.25, 100);
    const double rate = rates.nodes.at("a:1").bytesPerSecond;
    EXPECT_NEAR(rate, 1e7, 2e6);
    EXPECT_NEAR(std::stod(lines[1].substr(lines[1].find("2.5") + 12)), rate * 1e-6, 0.06) << lines[1];
}

TEST(NodeTable, AReasonTakesTheNumbersPlaceAndIsCut) {
    NodeReport lost = node("a:1", "lost", 0, 0);
    lost.detail = std::string(300, 'x');
    NodeRates rates;
    const auto lines = nodeTable({lost}, rates, 1, 80);
    EXPECT_NE(lines[1].find("xxx…"), std::string::npos) << lines[1];
    EXPECT_LE(lines[1].size(), 80u + 2);
}
