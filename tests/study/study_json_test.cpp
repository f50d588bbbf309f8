#include "client/study/study_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderengine/error.h"
#include "tests/study/study_fixture.h"

using namespace antipode;
using namespace antipode::study;

TEST(StudyRecord, ComesBackAsItWas) {
    const VariantResult result = study::test::sceneOfThree().variants[0];
    RunRecord record{result.spent, result.snapshots, "a device"};
    record.snapshots[2].errors.nonFinite = 3;
    const std::string text = encodeRecord(record);
    const RunRecord back = decodeRecord({text.begin(), text.end()}, "record.json");
    EXPECT_EQ(encodeRecord(back), text);
    EXPECT_EQ(back.snapshots[2].errors.nonFinite, 3u);
    EXPECT_EQ(back.spent.iterationCpu.squares, record.spent.iterationCpu.squares);
    EXPECT_EQ(back.spent.device(), record.spent.device());
}

TEST(StudyRecord, AnythingElseIsRefusedByName) {
    for (const std::string text : {"", "{}", "[1]", "no json", R"({"device":"x","iterations":"many"})"}) try {
            decodeRecord({text.begin(), text.end()}, "record.json");
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Input);
            EXPECT_NE(std::string(error.what()).find("'record.json' is no record of a study"), std::string::npos);
        }
}

TEST(StudyTables, HoldErrorsTimesAndTargets) {
    const std::vector<SceneResult> scenes{study::test::sceneOfThree()};
    const std::string csv = studyCsv(scenes);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 7);
    EXPECT_NE(csv.find("\n\"A \"\"room\"\" </script>\",vcm,1,0.1,0.19,"), std::string::npos) << csv.substr(0, 300);
    const auto json = nlohmann::json::parse(studyJson(scenes, false));
    const auto& vcm = json["scenes"][0]["variants"][0];
    EXPECT_EQ(vcm["name"], "vcm");
    EXPECT_NEAR(vcm["by"]["wall"]["slope"]["value"], -0.5, 1e-9);
    EXPECT_NEAR(vcm["by"]["wall"]["time_to"]["5"]["seconds"], 1.6, 1e-6) << "20 % at .1 s, a quarter of it at 1.6 s";
    EXPECT_EQ(vcm["by"]["wall"]["time_to"]["5"]["extrapolated"], false);
    EXPECT_NEAR(vcm["by"]["cpu"]["time_to"]["1"]["seconds"], 1.9 * 40, 1e-6);
    EXPECT_EQ(vcm["by"]["cpu"]["time_to"]["1"]["extrapolated"], true);
    EXPECT_FALSE(vcm.contains("image"));
}
