// A render's bytes do not depend on the number of threads of a device on the CPU. Drivers read that number when they
// start, so each render is a process of its own. On other devices the variable means nothing and the test holds
// trivially.
#include <gtest/gtest.h>

#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/client/run_client.h"
#include "tests/film/temporary_folder.h"

namespace antipode::test {
namespace {

std::string hashWith(const std::string& threads, const std::string& technique) {
    const TemporaryFolder folder;
    const std::string scene = ANTIPODE_SOURCE_DIR "/scenes/cornell/area.textproto";
    const ClientRun run = runClient(folder.file("."),
                                    "render '" + scene + "' --width 48 --height 32 --iterations 3 --technique " +
                                        technique + " --output image.exr --stats stats.json --quiet",
                                    "LP_NUM_THREADS=" + threads);
    EXPECT_EQ(run.exitCode, 0) << run.errors;
    std::ifstream file(folder.file("stats.json"));
    return nlohmann::json::parse(file)["sums_sha256"].get<std::string>();
}

TEST(EngineThreads, DoNotShowInTheImage) {
    for (const char* technique : {"vcm", "bpt", "lt"}) {
        const std::string one = hashWith("1", technique);
        EXPECT_EQ(hashWith("2", technique), one) << technique;
        EXPECT_EQ(hashWith("3", technique), one) << technique;
    }
}

}  // namespace
}  // namespace antipode::test
