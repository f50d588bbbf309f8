// Images whose light vertices outgrow what a device can bind or dispatch at once.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderengine/film.h"
#include "support/hard_case.h"
#include "tests/client/run_client.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::runClient;

/// Full HD with merging: more than 65,535 workgroups of grid cells, and on lavapipe more light vertices than one
/// storage buffer holds, so that fewer light paths are traced, which must not change the mean. H₀: the image's mean is
/// that of the same view at 240×135 (64 iterations as many samples); the standard error of either is below 0.1 %, the
/// test allows 1 %.
TEST(LargeImage, FullHdMergesAndKeepsTheMean) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(runClient(folder.file("."), "devices").exitCode, 0) << "no usable device";
    const std::string scene = std::string("'") + ANTIPODE_SOURCE_DIR + "/scenes/cornell/area.textproto' --quiet ";
    const auto large =
        runClient(folder.file("."),
                  "render " + scene + "--width 1920 --height 1080 --iterations 1 -o large.exr --stats stats.json");
    ASSERT_EQ(large.exitCode, 0) << large.errors;
    const auto small =
        runClient(folder.file("."), "render " + scene + "--width 240 --height 135 --iterations 64 -o small.exr");
    ASSERT_EQ(small.exitCode, 0) << small.errors;

    std::ifstream file(folder.file("stats.json"));
    const auto stats = nlohmann::json::parse(file);
    EXPECT_EQ(stats["events"], nlohmann::json::array());
    EXPECT_GT(stats["light_paths_per_iteration"], 1000000u);
    const auto mean = [&](const char* name) {
        const Image image = readExr(folder.file(name));
        Vec3d sum;
        for (const Vec3f& pixel : image.pixels) sum += Vec3d(pixel);
        return sum / double(image.pixels.size());
    };
    const Vec3d a = mean("large.exr"), b = mean("small.exr");
    for (int channel = 0; channel < 3; ++channel)
        antipode::expectWithin({"Images", "1920 × 1080: more groups and light vertices than a device takes at once",
                                "largest relative difference of the mean from that of 240 × 135", 0.01},
                               std::abs(a[channel] / b[channel] - 1), stats["device"]);
}
