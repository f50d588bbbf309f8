#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderengine/film.h"
#include "tests/client/run_client.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::ClientRun;
using test::runClient;
using test::TemporaryFolder;

namespace {

void writeGrey(const std::string& path, float value) {
    writeExr(path, {2, 2, std::vector<Vec3f>(4, Vec3f(value))}, {});
}

}  // namespace

TEST(ClientCompare, JsonHoldsTheMeasures) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), 1.5f);
    writeGrey(folder.file("b.exr"), 1);
    const ClientRun run = runClient(folder.file("."), "compare a.exr b.exr --json");
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    const auto json = nlohmann::json::parse(run.output);
    EXPECT_EQ(json["mean_a"], nlohmann::json({1.5, 1.5, 1.5}));
    EXPECT_EQ(json["ratio"][2], 1.5);
    EXPECT_DOUBLE_EQ(json["rmse"], 0.5);
    EXPECT_NEAR(json["rel_mse"], 0.25 / 1.01, 1e-15);
    EXPECT_NEAR(json["relative_error_percent"], 100 * 0.5 / std::sqrt(1.01), 1e-9);
    EXPECT_GT(json["flip"], 0.01);
    EXPECT_LT(json["flip"], 1);
    EXPECT_EQ(json["worst"].size(), 4u);
    EXPECT_EQ(json["non_finite_a"], 0);
}

TEST(ClientCompare, JsonStaysValidWithoutAnyFinitePixel) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), std::numeric_limits<float>::infinity());
    writeGrey(folder.file("b.exr"), 1);
    const ClientRun run = runClient(folder.file("."), "compare --json a.exr b.exr");
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    const auto json = nlohmann::json::parse(run.output);
    EXPECT_TRUE(json["rmse"].is_null());
    EXPECT_EQ(json["non_finite_a"], 4);
}

TEST(ClientCompare, TextShowsTheMeasures) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), -0.25f);
    writeGrey(folder.file("b.exr"), 0.5f);
    const ClientRun run = runClient(folder.file("."), "compare a.exr b.exr");
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    for (const char* text : {"mean A", "-0.25", "A / B", "-0.5", "RMSE", "0.75", "relMSE", "error", "FLIP",
                             "4 in A, 0 in B", "worst pixels"})
        EXPECT_NE(run.output.find(text), std::string::npos) << text << "\n" << run.output;
}

TEST(ClientCompare, FailsAboveTheLimitAndOnlyThere) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), 1.5f);  // 100·√(.25/1.01) = 49.75 %
    writeGrey(folder.file("b.exr"), 1);
    EXPECT_EQ(runClient(folder.file("."), "compare a.exr b.exr --fail-above 49.8").exitCode, 0);
    const ClientRun above = runClient(folder.file("."), "compare a.exr b.exr --fail-above 49.7 --json");
    EXPECT_EQ(above.exitCode, 1);
    EXPECT_EQ(above.errors, "antipode: The relative error is 49.75 %, above the limit of 49.7 %.\n");
    EXPECT_NEAR(nlohmann::json::parse(above.output)["rel_mse"], 0.25 / 1.01, 1e-15) << "measured all the same";
    EXPECT_EQ(runClient(folder.file("."), "compare a.exr b.exr --fail-above 0").exitCode, 2);
    EXPECT_EQ(runClient(folder.file("."), "compare a.exr b.exr --fail-above x").exitCode, 2);
}

TEST(ClientCompare, OnePixelThatIsNotFiniteFailsHoweverHighTheLimit) {
    const TemporaryFolder folder;
    Image image{2, 2, std::vector<Vec3f>(4, Vec3f(1))};
    writeExr(folder.file("whole.exr"), image, {});
    image.pixels[2].y = std::numeric_limits<float>::quiet_NaN();
    writeExr(folder.file("broken.exr"), image, {});
    for (const char* images : {"broken.exr whole.exr", "whole.exr broken.exr"}) {
        const ClientRun run = runClient(folder.file("."), std::string("compare --fail-above 1e9 ") + images);
        EXPECT_EQ(run.exitCode, 1);
        EXPECT_NE(run.errors.find("not finite: "), std::string::npos) << run.errors;
    }
}

TEST(ClientCompare, WritesAMapBesideNothingElse) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), 2);
    writeGrey(folder.file("b.exr"), 1);
    ASSERT_EQ(runClient(folder.file("."), "compare a.exr b.exr --diff map.png").exitCode, 0);
    std::ifstream map(folder.file("map.png"), std::ios::binary);
    char magic[4] = {};
    map.read(magic, 4);
    EXPECT_EQ(std::string(magic + 1, 3), "PNG");
    const ClientRun own = runClient(folder.file("."), "compare a.exr b.exr --diff a.exr");
    EXPECT_EQ(own.exitCode, 2);
    EXPECT_NE(own.errors.find("would overwrite the image 'a.exr'"), std::string::npos) << own.errors;
    EXPECT_EQ(runClient(folder.file("."), "compare a.exr b.exr --diff missing/map.png").exitCode, 1);
}

TEST(ClientCompare, FailuresNameTheFile) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), 1);
    std::ofstream(folder.file("text.exr")) << "no image";
    const ClientRun missing = runClient(folder.file("."), "compare a.exr missing.exr");
    EXPECT_EQ(missing.exitCode, 1);
    EXPECT_EQ(missing.errors, "antipode: Cannot read 'missing.exr': No such file or directory.\n");
    const ClientRun text = runClient(folder.file("."), "compare text.exr a.exr");
    EXPECT_EQ(text.exitCode, 1);
    EXPECT_NE(text.errors.find("'text.exr'"), std::string::npos) << text.errors;
}

TEST(ClientCompare, DifferentSizesAreAUsageError) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), 1);
    writeExr(folder.file("b.exr"), {1, 1, {Vec3f(1)}}, {});
    const ClientRun run = runClient(folder.file("."), "compare a.exr b.exr");
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_NE(run.errors.find("2x2 and 1x1"), std::string::npos) << run.errors;
}

TEST(ClientCompare, FullStandardOutputIsAFailure) {
    const TemporaryFolder folder;
    writeGrey(folder.file("a.exr"), 1);
    // The last ':' takes the redirection that runClient appends.
    for (const std::string arguments : {"compare a.exr a.exr", "compare a.exr a.exr --json", "--help"})
        EXPECT_EQ(runClient(folder.file("."), arguments + " >/dev/full 2>errors; exit $?; :").exitCode, 1) << arguments;
}
