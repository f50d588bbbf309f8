#include "client/explanation.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "farm/jobs/job_definition.h"
#include "tests/support/fake_renderer.h"

using namespace antipode;

namespace {

Explanation explained(const Scene& scene) { return explainScene(scene, resolveJob(scene, {}).settings); }

bool renders(const Explanation& e, const std::string& technique, const std::string& words) {
    for (const LightRow& row : e.light)
        for (size_t i = 0; i < e.techniques.size(); ++i)
            if (row.words == words && e.techniques[i] == technique) return row.techniques[i];
    ADD_FAILURE() << technique << ": " << words;
    return false;
}

}  // namespace

TEST(Explanation, SaysWhoRendersWhat) {
    const Explanation e = explained(test::mirrorScene());
    EXPECT_EQ(e.triangles, 2u);
    EXPECT_EQ(e.spheres, 1u);
    EXPECT_EQ(e.lamps, 1u);
    const std::string caustics = "caustics of points, spots and suns";
    EXPECT_TRUE(renders(e, "vcm", caustics));
    EXPECT_TRUE(renders(e, "bpt", caustics));
    EXPECT_FALSE(renders(e, "pt", caustics));
    EXPECT_FALSE(renders(e, "bpt", caustics + ", seen in mirrors or through glass"));
    EXPECT_TRUE(renders(e, "vcm", caustics + ", seen in mirrors or through glass"));
    EXPECT_EQ(explained(test::tinyScene()).light.size(), 2u) << "no mirror, no caustic";
}

TEST(Explanation, FitsAPageAndNamesWhatIsAbsent) {
    Explanation e = explained(test::mirrorScene());
    e.costs = SceneCosts{"a device",
                         96,
                         64,
                         {{"camera paths", 0.03}, {"merging", 0.01}},
                         {{"lens", "a lens", 2, 1.9, 2.1}, {"textures", "textures", 1.02, 0.98, 1.1}}};
    const std::string text = explanationText(e, false);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (uint8_t(c) & 0xC0) != 0x80; }), 120)
            << line;
        EXPECT_TRUE(line.empty() || line.back() != ' ') << "'" << line << "'";
        EXPECT_EQ(line.find('\x1b'), std::string::npos) << "styled though nobody asked";
    }
    const size_t has = text.find("What the scene has"), lacks = text.find("What is not simulated");
    ASSERT_NE(lacks, std::string::npos);
    EXPECT_LT(text.find("mirrors"), lacks);
    EXPECT_GT(text.find("normal maps"), lacks) << "absent, and said to be";
    EXPECT_LT(has, lacks);
    EXPECT_NE(text.find("40.0 ms"), std::string::npos) << "an iteration is the sum of its parts";
    EXPECT_NE(text.find("75 %"), std::string::npos);
    EXPECT_NE(text.find("100 %"), std::string::npos) << "the lens doubles the time";
    EXPECT_NE(text.find("20.0 ms"), std::string::npos) << "and is half of it";
    EXPECT_NE(text.find("nothing that could be measured"), std::string::npos);
    EXPECT_NE(explanationText(e, true).find("\x1b[1m"), std::string::npos);
}

TEST(Explanation, IsJsonForPrograms) {
    const auto json = nlohmann::json::parse(explanationJson(explained(test::mirrorScene())));
    EXPECT_EQ(json["technique"], "vcm");
    EXPECT_FALSE(json.contains("costs")) << "nothing was measured";
    size_t present = 0;
    for (const auto& effect : json["effects"]) present += effect["present"].get<bool>();
    EXPECT_EQ(present, 5u) << "triangles, a sphere, matte, a mirror, a point lamp: " << json["effects"];
    EXPECT_EQ(json["light"].size(), 6u) << json["light"];
}

TEST(Explanation, TellsInThreeLinesBeforeARender) {
    const Scene scene = test::mirrorScene();
    std::vector<std::string> lines = sceneInShort(scene, resolveJob(scene, {}));
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0], "scene: 2 triangles, 1 sphere, 1 point lamp");
    EXPECT_EQ(lines[1],
              "light: direct and indirect, caustics, and all of it in mirrors or through glass; no lamp has a size");
    EXPECT_EQ(lines[2], "technique: vcm, renders all of it");
    RenderSettings settings;
    settings.technique = "pt";
    EXPECT_NE(sceneInShort(scene, resolveJob(scene, settings))[2].find(
                  "the image will lack caustics of points, spots and suns"),
              std::string::npos);
}
