#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderengine/film.h"
#include "tests/client/run_client.h"
#include "tests/film/exr_channels.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::ClientRun;
using test::runClient;
using test::TemporaryFolder;

namespace {

/// A lamp over a floor, in a folder of its own.
class ClientRender : public testing::Test {
protected:
    void SetUp() override {
        if (runClient(folder.file("."), "devices").exitCode != 0) GTEST_SKIP() << "This machine has no usable device.";
        std::ofstream(folder.file("lamp.mtl")) << "newmtl lamp\nKd 0 0 0\nKe 4 3 2\nnewmtl floor\nKd .5 .5 .5\n";
        std::ofstream(folder.file("lamp.obj")) << "mtllib lamp.mtl\n"
                                                  "v -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\n"
                                                  "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                                                  "usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
    }

    nlohmann::json statsOf(const std::string& name) const {
        std::ifstream file(folder.file(name));
        return nlohmann::json::parse(file);
    }

    TemporaryFolder folder;
};

}  // namespace

TEST_F(ClientRender, FramesThatAreThereAreNotRenderedAgain) {
    const std::string command = "render lamp.obj --width 8 --height 8 --iterations 2 --technique pt -o f_##.exr ";
    ASSERT_EQ(runClient(folder.file("."), command + "--frames 9-10").exitCode, 0);
    EXPECT_TRUE(std::filesystem::exists(folder.file("f_09.exr")) && std::filesystem::exists(folder.file("f_10.png")));
    std::filesystem::remove(folder.file("f_10.exr"));
    const auto rendered = [&](const std::string& options) {
        const ClientRun run = runClient(folder.file("."), command + options);
        EXPECT_EQ(run.exitCode, 0) << run.errors;
        return std::pair(run.output.find("wrote f_09.exr") != std::string::npos,
                         run.output.find("wrote f_10.exr") != std::string::npos);
    };
    EXPECT_EQ(rendered("--frames 9-10"), std::pair(false, true)) << "the one that is missing";
    EXPECT_EQ(rendered("--frames 9-10"), std::pair(false, false));
    EXPECT_EQ(rendered("--frames 9 --overwrite"), std::pair(true, false));
    EXPECT_EQ(rendered("--frames 9 --seed 3"), std::pair(true, false)) << "of another job";
    std::ofstream(folder.file("f_10.exr"), std::ios::app) << "cut";
    std::filesystem::resize_file(folder.file("f_10.exr"), 700);
    EXPECT_EQ(rendered("--frames 10"), std::pair(false, true)) << "not a whole image";
}

TEST_F(ClientRender, ImagesAreShownAgain) {
    writeExr(folder.file("a.exr"), Image{2, 1, {Vec3f(0.25f), Vec3f(0.5f)}}, {});
    for (const char* options : {"", "-o b.jpg --quality 80", "-o c.png --bits 16 --exposure 1 --white-balance 3200"}) {
        const ClientRun run = runClient(folder.file("."), std::string("tonemap a.exr ") + options);
        EXPECT_EQ(run.exitCode, 0) << run.errors;
    }
    EXPECT_EQ(folder.names().size(), 6u);  // with the two of the model
    for (const char* options : {"-o b.gif", "--bits 12", "-o b.jpg --bits 16", "--white-balance 900", "--quality 101"})
        EXPECT_EQ(runClient(folder.file("."), std::string("tonemap a.exr ") + options).exitCode, 2) << options;
}

TEST_F(ClientRender, WritesTheImagesAndTheStatistics) {
    const ClientRun run = runClient(folder.file("."),
                                    "render lamp.obj --width 24 --height 16 --technique pt "
                                    "--iterations 3 --seed 7 --stats stats.json");
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    EXPECT_NE(run.output.find("24x16, pt, 3 iterations"), std::string::npos) << run.output;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"lamp.exr", "lamp.mtl", "lamp.obj", "lamp.png", "stats.json"}));

    ImageMetadata metadata;
    const Image image = readExr(folder.file("lamp.exr"), &metadata);
    EXPECT_EQ(image.width, 24u);
    EXPECT_EQ(image.height, 16u);
    const ImageComparison toItself = compareImages(image, image);
    EXPECT_EQ(toItself.nonFiniteA + toItself.negativeA, 0u);
    EXPECT_GT(maxComponent(toItself.meanA), 0.0) << "the image is black";

    const auto stats = statsOf("stats.json");
    EXPECT_EQ(stats["iterations"], 3);
    EXPECT_EQ(stats["seed"], 7);
    EXPECT_EQ(stats["technique"], "pt");
    EXPECT_EQ(stats["scene"], "lamp.obj");
    EXPECT_EQ(stats["precision"], "float");
    EXPECT_EQ(stats["counters"], (nlohmann::json{{"non_finite", 0},
                                                 {"negative", 0},
                                                 {"zero_pdf", 0},
                                                 {"saturated", 0},
                                                 {"loop_limit", 0},
                                                 {"stack_overflow", 0},
                                                 {"sum_overflow", 0}}));
    EXPECT_EQ(stats["events"], nlohmann::json::array());
    EXPECT_EQ(metadata["antipode.precision"], "float");
    EXPECT_EQ(metadata["antipode.events"], "none");
    EXPECT_GT(stats["rays"], 0);
    EXPECT_GT(stats["wall_seconds"], 0.0);
    EXPECT_FALSE(stats["stages"].empty());
    EXPECT_EQ(metadata["antipode.sumsSha256"], stats["sums_sha256"]);
    EXPECT_EQ(metadata["antipode.sceneHash"], stats["scene_hash"]);
    EXPECT_EQ(metadata["antipode.iterations"], "3");
    EXPECT_EQ(metadata["antipode.device"], stats["device"]);
}

TEST_F(ClientRender, ShowsWhereTheImageErrs) {
    const std::string command =
        "render lamp.obj --width 24 --height 16 --technique pt --layers noise --error-map map.png "
        "--stats stats.json --iterations ";
    ASSERT_EQ(runClient(folder.file("."), command + "8").exitCode, 0);
    const auto channels = test::channelsOf(folder.file("lamp.exr"));
    ASSERT_TRUE(channels.contains("noise.R") && channels.contains("noise.G") && channels.contains("noise.B"));
    for (const float error : channels.at("noise.G")) EXPECT_TRUE(std::isfinite(error) && error >= 0);
    EXPECT_GT(std::ranges::max(channels.at("noise.G")), 0);
    EXPECT_EQ(std::ranges::count(folder.names(), "map.png"), 1);
    EXPECT_GT(statsOf("stats.json")["error"]["percent"], 0.0);

    ASSERT_EQ(runClient(folder.file("."), command + "1").exitCode, 0);
    const auto unknown = test::channelsOf(folder.file("lamp.exr"));
    for (const float error : unknown.at("noise.G")) EXPECT_TRUE(std::isnan(error));

    const ClientRun refused = runClient(folder.file("."), command + "1 --no-error");
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.errors.find("--layers noise needs the estimate"), std::string::npos) << refused.errors;
}

TEST_F(ClientRender, DenoisesAndKeepsTheNoisyImage) {
    const std::string command = "render lamp.obj --width 24 --height 16 --technique pt --iterations ";
    ASSERT_EQ(runClient(folder.file("."), command + "8 -o noisy.exr").exitCode, 0);
    ASSERT_EQ(runClient(folder.file("."), command + "8 -o denoised.exr --denoise").exitCode, 0);
    const auto noisy = test::channelsOf(folder.file("noisy.exr")), both = test::channelsOf(folder.file("denoised.exr"));
    for (const char* channel : {"R", "G", "B"}) {
        EXPECT_EQ(both.at(std::string("noisy.") + channel), noisy.at(channel));
        EXPECT_NE(both.at(channel), noisy.at(channel));
        for (const float value : both.at(channel)) EXPECT_TRUE(std::isfinite(value) && value >= 0);
    }

    const ClientRun one = runClient(folder.file("."), command + "1 -o one.exr --denoise");
    EXPECT_EQ(one.exitCode, 0);
    EXPECT_NE(one.errors.find("nothing is denoised"), std::string::npos) << one.errors;
    EXPECT_FALSE(test::channelsOf(folder.file("one.exr")).contains("noisy.R"));

    const ClientRun refused = runClient(folder.file("."), command + "8 --denoise --no-error");
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.errors.find("--denoise needs the estimate"), std::string::npos) << refused.errors;
}

TEST_F(ClientRender, RepeatsToTheByteAndFollowsTheSeed) {
    const std::string command = "render lamp.obj --width 16 --height 16 --technique pt --iterations 2 --quiet";
    const auto hashOf = [&](const std::string& options) {
        const ClientRun run = runClient(folder.file("."), command + options + " --stats stats.json");
        EXPECT_EQ(run.exitCode, 0) << run.errors;
        EXPECT_EQ(run.output + run.errors, "");
        return statsOf("stats.json")["sums_sha256"].get<std::string>();
    };
    const std::string first = hashOf(""), second = hashOf(""), other = hashOf(" --seed 2");
    EXPECT_EQ(first, second);
    EXPECT_NE(first, other);
}

TEST_F(ClientRender, DoubleIsSaidAndIsAnotherJob) {
    const std::string command = "render lamp.obj --width 8 --height 8 --technique pt --iterations 1 ";
    const ClientRun run = runClient(folder.file("."), command + "--precision double --stats stats.json --checkpoint c");
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    EXPECT_NE(run.output.find("8x8, pt, double precision, 1 iteration"), std::string::npos) << run.output;
    EXPECT_EQ(statsOf("stats.json")["precision"], "double");
    ImageMetadata metadata;
    readExr(folder.file("lamp.exr"), &metadata);
    EXPECT_EQ(metadata["antipode.precision"], "double");

    const ClientRun resumed = runClient(folder.file("."), command + "--resume c");
    EXPECT_EQ(resumed.exitCode, 2);
    EXPECT_NE(resumed.errors.find("precision is double, not float"), std::string::npos) << resumed.errors;
}

TEST_F(ClientRender, OneSideTakesTheOtherWithIt) {
    const std::string common = " --technique pt --iterations 1 --quiet";
    ASSERT_EQ(runClient(folder.file("."), "render lamp.obj -o a.exr --width 32" + common).exitCode, 0);
    const Image a = readExr(folder.file("a.exr"));
    EXPECT_EQ(a.width, 32u);
    const std::string height = std::to_string(a.height);
    ASSERT_EQ(runClient(folder.file("."), "render lamp.obj -o b.exr --height " + height + common).exitCode, 0);
    EXPECT_EQ(readExr(folder.file("b.exr")).width, 32u);
}

TEST_F(ClientRender, TimeEndsARenderAfterAtLeastOneIteration) {
    const ClientRun run = runClient(
        folder.file("."), "render lamp.obj --width 8 --height 8 --technique pt --time 1e-9 --stats stats.json");
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    EXPECT_EQ(statsOf("stats.json")["iterations"], 1);
    EXPECT_FALSE(statsOf("stats.json")["interrupted"].get<bool>());
}

TEST_F(ClientRender, AnInterruptedRenderIsWritten) {
    // Interrupts once the first progress line shows that iterations are under way; the last ':' takes the redirection
    // that runClient appends.
    const ClientRun run = runClient(
        folder.file("."),
        "render lamp.obj --width 16 --height 16 --technique pt --time 60 --stats stats.json >out 2>errors & "
        "while kill -0 $! && ! grep -qs 'it/s' errors; do sleep 0.1; done; kill -TERM $!; wait $!; exit $?; :");
    EXPECT_EQ(run.exitCode, 0);
    const auto stats = statsOf("stats.json");
    EXPECT_TRUE(stats["interrupted"].get<bool>());
    EXPECT_LT(stats["wall_seconds"], 60.0);
    EXPECT_EQ(readExr(folder.file("lamp.exr")).width, 16u);
}

TEST_F(ClientRender, TheGroupsInterruptOfTimeoutLosesNothing) {
    // GNU timeout signals the process and then its group, so that it hears twice.
    const ClientRun run = runClient(folder.file("."), "--version && timeout -s INT 4 '" ANTIPODE_BINARY
                                                      "' render lamp.obj --width 16 --height 16 --technique pt "
                                                      "--time 60 --stats stats.json; test $? = 124");
    EXPECT_EQ(run.exitCode, 0) << run.errors;
    EXPECT_TRUE(statsOf("stats.json")["interrupted"].get<bool>());
    EXPECT_GT(statsOf("stats.json")["iterations"], 0);
    EXPECT_EQ(readExr(folder.file("lamp.exr")).width, 16u);
}

TEST_F(ClientRender, UnknownDevicesAreAUsageError) {
    const ClientRun run = runClient(folder.file("."), "render lamp.obj --device ffffffffffffffffffffffffffffffff");
    EXPECT_EQ(run.exitCode, 2) << run.errors;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"lamp.mtl", "lamp.obj"}));
}

TEST_F(ClientRender, LightThatIsLeftOutIsRefusedOrRecorded) {
    std::ofstream(folder.file("ball.textproto"))
        << "material { name: 'grey' } material { name: 'mirror' kind: MIRROR }\n"
           "sphere { center: [0, -100, 0] radius: 100 material: 'grey' } sphere { center: [0, 1, 0] radius: 1 "
           "material: 'mirror' }\n"
           "point_light { position: [0, 4, 4] intensity: [9, 9, 9] }\n"
           "camera { position: [0, 2, 8] forward: [0, 0, -1] up: [0, 1, 0] vertical_fov: 45 }\n";
    const std::string command = "render ball.textproto --width 8 --height 8 --iterations 1 --stats stats.json ";
    const ClientRun refused = runClient(folder.file("."), command + "--without merging");
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.errors.find("vcm without merging renders no caustics of points, spots and suns, seen in mirrors"),
              std::string::npos)
        << refused.errors;
    const ClientRun allowed = runClient(folder.file("."), command + "--without merging --allow-missing");
    ASSERT_EQ(allowed.exitCode, 0) << allowed.errors;
    EXPECT_NE(allowed.errors.find("the image will lack caustics"), std::string::npos) << allowed.errors;
    EXPECT_EQ(statsOf("stats.json")["without"], "merging");
    EXPECT_EQ(statsOf("stats.json")["missing"][0]["paths"], "LS+DS+E");
    ImageMetadata metadata;
    readExr(folder.file("ball.exr"), &metadata);
    EXPECT_EQ(metadata["antipode.without"], "merging");
    EXPECT_NE(metadata["antipode.missing"].find("LS+DS+E"), std::string::npos);
    const ClientRun fixed = runClient(folder.file("."), command + "--technique bpt");
    EXPECT_EQ(fixed.exitCode, 0);
    EXPECT_NE(fixed.errors.find("technique: bpt; the image will lack caustics"), std::string::npos)
        << "a technique by name is told, not refused";
    EXPECT_EQ(runClient(folder.file("."), command + "--light-paths 0").exitCode, 2);
}
