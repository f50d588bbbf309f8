#include <filesystem>
#include <fstream>

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

/// A lamp over a floor, in a folder of its own.
class ClientStudy : public testing::Test {
protected:
    void SetUp() override {
        if (runClient(folder.file("."), "devices").exitCode != 0) GTEST_SKIP() << "This machine has no usable device.";
        std::ofstream(folder.file("lamp.mtl")) << "newmtl lamp\nKd 0 0 0\nKe 4 3 2\nnewmtl floor\nKd .5 .5 .5\n";
        std::ofstream(folder.file("lamp.obj")) << "mtllib lamp.mtl\n"
                                                  "v -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\n"
                                                  "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                                                  "usemtl floor\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
    }

    nlohmann::json study() const {
        std::ifstream file(folder.file("out/study.json"));
        return nlohmann::json::parse(file);
    }

    TemporaryFolder folder;
};

const std::string small = "study lamp.obj --out out --width 24 --height 16 --knobs pt,length-3 --reference-seconds .3 ";

}  // namespace

TEST_F(ClientStudy, MeasuresEachVariantAndGoesOnWhereItWas) {
    const ClientRun run = runClient(folder.file("."), small + "--budget .1");
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    for (const char* name : {"study.csv", "study.json", "index.html"})
        EXPECT_GT(std::filesystem::file_size(folder.file("out/" + std::string(name))), 100u) << name;
    const auto first = study();
    const auto& variants = first["scenes"][0]["variants"];
    ASSERT_EQ(variants.size(), 3u);
    for (const auto& variant : variants) {
        EXPECT_GE(variant["snapshots"].size(), 2u) << variant["name"];
        EXPECT_GT(variant["snapshots"][0]["percent"], 0) << variant["name"];
        EXPECT_EQ(variant["snapshots"][0]["iterations"], 1);
        EXPECT_EQ(variant["snapshots"].back()["iterations"], variant["iterations"]);
    }
    EXPECT_EQ(first["scenes"][0]["prices"].size(), 2u);

    ASSERT_EQ(runClient(folder.file("."), small + "--budget .1").exitCode, 0);
    EXPECT_EQ(study(), first) << "nothing was left to do";

    ASSERT_EQ(runClient(folder.file("."), small + "--budget .2").exitCode, 0);
    const auto more = study();
    for (size_t i = 0; i < 3; ++i) {
        const auto &before = variants[i], &after = more["scenes"][0]["variants"][i];
        EXPECT_GT(after["iterations"], before["iterations"]);
        for (size_t s = 0; s < before["snapshots"].size(); ++s)
            EXPECT_EQ(after["snapshots"][s], before["snapshots"][s]) << "what was measured stays";
    }
}

TEST_F(ClientStudy, TakesAReferenceAndRefusesOneOfAnotherSize) {
    writeExr(folder.file("reference.exr"), {24, 16, std::vector<Vec3f>(24 * 16, Vec3f(0.1f))}, {});
    writeExr(folder.file("other.exr"), {2, 2, std::vector<Vec3f>(4)}, {});
    const std::string given = "study lamp.obj --out out --width 24 --height 16 --knobs pt --budget .05 --reference ";
    ASSERT_EQ(runClient(folder.file("."), given + "reference.exr").exitCode, 0);
    EXPECT_EQ(study()["scenes"][0]["reference"], "given (reference.exr)");
    EXPECT_TRUE(study()["scenes"][0]["reference_percent"].is_null());
    const ClientRun other = runClient(folder.file("."), given + "other.exr");
    EXPECT_EQ(other.exitCode, 2);
    EXPECT_NE(other.errors.find("2x2"), std::string::npos) << other.errors;
    EXPECT_EQ(runClient(folder.file("."), given + "missing.exr").exitCode, 1);
}

TEST_F(ClientStudy, BrokenStateIsNamed) {
    ASSERT_EQ(runClient(folder.file("."), small + "--budget .05").exitCode, 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder.file("out/state")))
        if (entry.path().string().ends_with("pt.json")) std::ofstream(entry.path()) << "torn";
    const ClientRun run = runClient(folder.file("."), small + "--budget .05");
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_NE(run.errors.find("is no record of a study: remove it"), std::string::npos) << run.errors;
}

TEST(ClientStudyUsage, MistakesAreOneSentence) {
    const TemporaryFolder folder;
    const auto fails = [&](const std::string& arguments, const std::string& words) {
        const ClientRun run = runClient(folder.file("."), arguments);
        EXPECT_EQ(run.exitCode, 2) << arguments << run.errors;
        EXPECT_NE(run.errors.find(words), std::string::npos) << run.errors;
        EXPECT_TRUE(folder.names().empty()) << arguments;
    };
    fails("study", "needs the argument SCENE");
    fails("study a.textproto", "needs --out FOLDER");
    fails("study a.textproto --out x --knobs doubel", "Did you mean 'double'?");
    fails("study a.textproto --out x --budget 0", "--budget takes a number above 0");
    fails("study a.textproto b.textproto --out x --reference r.exr", "--reference goes with one scene");
}
