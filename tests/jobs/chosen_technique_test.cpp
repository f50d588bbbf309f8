// The technique that a pilot chooses renders all of the light, on a device.
//
// Statistics. One iteration's mean over the image, or over one of 4 × 3 blocks, is one sample. H0: the technique that
// was chosen and vcm have the same expectation there. Welch's t-test, α = .01 over all tests of this file (Šidák); seed
// 7, whose numbers the pilot does not use. Compared are means with a standard error below 8 %: those of rarer events
// are too far from normal. The whole image's has to be.
#include <gtest/gtest.h>

#include "farm/jobs/technique_choice.h"
#include "tests/techniques/agreement_scenes.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 48, kColumns = 4, kRows = 3;
constexpr uint64_t kIterations = 32;
constexpr double kGreatestError = 0.08;

/// A small lamp in a ball of glass lights a floor, and is out of view: hardly any path of pt finds it.
Scene lampInGlass() {
    Scene scene;
    const uint32_t grey = addLambert(scene, Vec3f(0.5f)), glass = addGlass(scene);
    addHorizontalSquare(scene, {0, 0, 0}, 12, grey);
    scene.spheres = {{{0, 2, 0}, 0.5f, glass}, {{0, 2, 0}, 0.01f, addLamp(scene, Vec3f(2000.0f))}};
    scene.camera = lookAt({0, 3, 5}, {0, 0, 2}, {0, 1, 0}, 0.8);
    return scene;
}

struct Case {
    const char* name;
    Scene (*scene)();
    size_t tried;  ///< techniques: pt is none of them where something is specular
};

constexpr Case kCases[] = {{"Sky", skyScene, 3}, {"Specular", specularScene, 2}, {"Blended", blendedScene, 3}};

class ChosenTechnique : public EngineTest, public testing::WithParamInterface<Case> {};

TEST_P(ChosenTechnique, LosesNoLight) {
    const Scene scene = GetParam().scene();
    RenderSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.seed = 7;
    settings.maxPathLength = 8;
    settings.initialRadius = 0.02;
    PilotOptions pilot;
    pilot.seconds = 0.5;
    pilot.renderers = [](const Scene& tried, const RenderSettings& with) {
        return std::make_unique<Engine>(tried, with);
    };
    RenderSettings chosen = settings;
    const TechniqueChoice choice = chooseTechnique(scene, chosen, pilot);
    ASSERT_EQ(choice.measures.size(), GetParam().tried) << choice.reason;
    RecordProperty("technique", choice.technique);
    chosen.initialRadius = settings.initialRadius;
    chosen.seed = settings.seed + 1;  // so that vcm beside itself is a test, too
    const std::vector<Image> mine = renderEach(scene, chosen, kIterations),
                             all = renderEach(scene, settings, kIterations);
    const std::vector<Block> blocks = blocksOf(kWidth, kHeight, kColumns, kRows);
    for (const Block& block : blocks) {
        const Moments a = momentsOf(mine, block, 1), b = momentsOf(all, block, 1);
        const auto sharp = [](const Moments& m) { return std::sqrt(m.meanVariance()) < kGreatestError * m.mean(); };
        if (!sharp(a) || !sharp(b)) {
            EXPECT_NE(&block, &blocks.front()) << choice.technique << ": the test says nothing";
            continue;
        }
        EXPECT_GT(welchTest(a, b).pValue, sidak(kAlpha, std::size(kCases) * blocks.size()))
            << choice.technique << " " << a.mean() << ", vcm " << b.mean() << ", block " << block.left << ","
            << block.top << ": " << choice.reason;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ChosenTechnique, testing::ValuesIn(kCases),
                         [](const auto& scene) { return std::string(scene.param.name); });

/// It meets the lamp in no pilot, and so seems to render without noise.
TEST_F(EngineTest, PathTracingIsNotChosenForALampInGlass) {
    RenderSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    PilotOptions pilot;
    pilot.seconds = 0.5;
    pilot.renderers = [](const Scene& tried, const RenderSettings& with) {
        return std::make_unique<Engine>(tried, with);
    };
    EXPECT_NE(chooseTechnique(lampInGlass(), settings, pilot).technique, "pt");
}

}  // namespace
}  // namespace antipode::test
