// Thousands of farms with random faults, each a function of its seed. Run one again with its log:
// ANTIPODE_SEED=4711 fault_schedules_test
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/farm/simulation/fault_schedule.h"

namespace antipode::simulation {
namespace {

constexpr uint64_t seedsPerShard = 256;

bool survives(uint64_t seed, bool logged) {
    FaultSchedule schedule(seed);
    if (logged) schedule.farm().loop().keepLog();
    schedule.run();
    const std::vector<std::string> failures = schedule.failures();
    for (const std::string& failure : failures)
        ADD_FAILURE() << "ANTIPODE_SEED=" << seed << " after " << schedule.farm().seconds() << " s: " << failure;
    return failures.empty();
}

class FaultSchedules : public testing::TestWithParam<uint64_t> {};

TEST_P(FaultSchedules, EndInTheStandaloneImage) {
    if (const char* seed = std::getenv("ANTIPODE_SEED")) {
        if (GetParam() == 0) survives(std::stoull(seed), true);
        return;
    }
    int failed = 0;
    for (uint64_t seed = GetParam() * seedsPerShard; seed < (GetParam() + 1) * seedsPerShard && failed < 3; ++seed)
        failed += !survives(seed, false);
}

INSTANTIATE_TEST_SUITE_P(Shards, FaultSchedules, testing::Range<uint64_t>(0, 8));

}  // namespace
}  // namespace antipode::simulation
