// The choice of a technique: its rules, and its pilot, with renderers whose noise, cost and mean are known.
#include "farm/jobs/technique_choice.h"

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "renderengine/film_layout.h"
#include "tests/support/fake_renderer.h"

namespace antipode {
namespace {

/// What a technique renders in a fake pilot: grey pixels of a mean with normal noise, at a price.
struct FakeTechnique {
    double noise = 0.1, seconds = 1;
    std::function<double(uint32_t pixel)> mean = [](uint32_t) { return 0.5; };
    std::function<double(uint32_t pixel)> rare = [](uint32_t) { return 0.0; };  ///< on top: ± so much, of mean 0
};

class NoisyRenderer final : public Renderer {
public:
    NoisyRenderer(const RenderSettings& settings, const FakeTechnique& technique)
        : technique_(technique), seed_(settings.seed + std::hash<std::string>()(settings.technique)) {
        sums_.layout = filmLayout(settings);
        for (FilmLayer& layer : sums_.layout.layers) layer.scaleExponent = 30;
        reset();
    }
    void render(uint64_t iteration) override {
        std::mt19937_64 random(seed_ + iteration);
        std::normal_distribution<double> normal(0, technique_.noise);
        for (size_t i = 0; i < sums_.values.size(); i += 3) {
            const double rare = technique_.rare(uint32_t(i / 3));
            const double value = technique_.mean(uint32_t(i / 3)) + normal(random) + (random() % 2 == 0 ? rare : -rare);
            for (size_t c = 0; c < 3; ++c) sums_.values[i + c] += int64_t(std::ldexp(value, 30));
        }
        ++sums_.iterations;
        seconds_ += technique_.seconds;
    }
    FilmSums sums() const override { return sums_; }
    void reset() override {
        sums_.values.assign(sums_.layout.values(), 0);
        sums_.iterations = 0;
        seconds_ = 0;
    }
    EngineStatistics statistics() const override {
        EngineStatistics statistics;
        statistics.stages = {{"all", seconds_, 0}};
        return statistics;
    }

private:
    const FakeTechnique technique_;
    const uint64_t seed_;
    FilmSums sums_;
    double seconds_ = 0;
};

PilotOptions pilotOf(const std::map<std::string, FakeTechnique>& techniques) {
    PilotOptions pilot;
    pilot.renderers = [techniques](const Scene&, const RenderSettings& settings) {
        return std::make_unique<NoisyRenderer>(settings, techniques.at(settings.technique));
    };
    return pilot;
}

RenderSettings settingsOf(uint32_t side = 64) {
    RenderSettings settings;
    settings.width = settings.height = side;
    settings.technique = automaticTechnique;
    return settings;
}

TechniqueChoice choose(const Scene& scene, const PilotOptions& pilot, RenderSettings settings = settingsOf()) {
    const TechniqueChoice choice = chooseTechnique(scene, settings, pilot);
    EXPECT_EQ(settings.technique, choice.technique);
    EXPECT_FALSE(choice.reason.empty());
    return choice;
}

TEST(TechniqueChoice, TriesNothingWhereOnlyOneRendersAllLight) {
    const TechniqueChoice choice = choose(test::mirrorScene(), pilotOf({}));
    EXPECT_EQ(choice.technique, "vcm");
    EXPECT_NE(choice.reason.find("nothing else renders caustics of points, spots and suns"), std::string::npos);
    EXPECT_TRUE(choice.measures.empty());
}

TEST(TechniqueChoice, GoesByRuleWithoutAPilot) {
    PilotOptions hasty = pilotOf({});
    hasty.seconds = 0.1;
    for (const PilotOptions& pilot : {PilotOptions(), hasty}) {
        EXPECT_EQ(choose(test::tinyScene(), pilot).technique, "bpt") << "nothing is specular";
        Scene scene = test::mirrorScene();
        scene.pointLights.clear();
        scene.environment.emplace().radiance = Vec3f(1.0f);
        EXPECT_EQ(choose(scene, pilot).technique, "vcm");
    }
}

TEST(TechniqueChoice, TakesWhatReachesAnErrorFirst) {
    // Time to the same error is noise² × seconds.
    const FakeTechnique vcm{0.1, 4};
    EXPECT_EQ(choose(test::tinyScene(), pilotOf({{"vcm", vcm}, {"bpt", {0.1, 2}}, {"pt", {0.2, 1}}})).technique, "bpt");
    EXPECT_EQ(choose(test::tinyScene(), pilotOf({{"vcm", vcm}, {"bpt", {0.1, 2}}, {"pt", {0.1, 1}}})).technique, "pt");
    EXPECT_EQ(choose(test::tinyScene(), pilotOf({{"vcm", vcm}, {"bpt", {0.3, 2}}, {"pt", {0.3, 1}}})).technique, "vcm");
    EXPECT_EQ(choose(test::tinyScene(), pilotOf({{"vcm", vcm}, {"bpt", {0.1, 3.6}}, {"pt", {0.3, 1}}})).technique,
              "vcm")
        << "a tenth is not worth it";
}

TEST(TechniqueChoice, MeasuresVarianceAndTime) {
    const TechniqueChoice choice =
        choose(test::tinyScene(), pilotOf({{"vcm", {0.1, 4}}, {"bpt", {0.2, 2}}, {"pt", {0.05, 8}}}));
    ASSERT_EQ(choice.measures.size(), 3u);
    for (const CandidateMeasure& m : choice.measures) {
        const double noise = m.technique == "vcm" ? 0.1 : m.technique == "bpt" ? 0.2 : 0.05;
        EXPECT_NEAR(m.variance, noise * noise / (0.5 * 0.5 + 0.01), 0.05 * m.variance) << m.technique;
        EXPECT_LT(m.trimmed, m.variance) << m.technique;
        EXPECT_FALSE(m.losesLight) << m.technique;
    }
    EXPECT_EQ(choice.measures[1].seconds, 2);
}

/// H0: what has the same mean is said to lose light by chance alone, by Student's t with 7 degrees of freedom once in
/// 1,000 (5 standard errors for the image, 10 for each of 16 tiles). Of 80 trials with seeds 0 … 39, more than two then
/// have a chance below 10^-4.
TEST(TechniqueChoice, LosesNoLightByChanceAlone) {
    int lost = 0;
    PilotOptions pilot = pilotOf({{"vcm", {0.1, 1}}, {"bpt", {0.3, 0.1}}, {"pt", {0.3, 0.1}}});
    for (uint64_t seed = 0; seed < 40; ++seed) {
        RenderSettings settings = settingsOf(32);
        settings.seed = seed;
        for (const CandidateMeasure& m : choose(test::tinyScene(), pilot, settings).measures) lost += m.losesLight;
    }
    EXPECT_LE(lost, 2);
}

/// What a technique never finds in a pilot makes it look quiet: it must not be taken for that.
TEST(TechniqueChoice, RefusesWhatIsDarkerThanItMayBe) {
    const auto caustic = [](uint32_t pixel) { return pixel % 64 < 8 && pixel / 64 < 8 ? 0.8 : 0.5; };
    const TechniqueChoice choice = choose(
        test::tinyScene(), pilotOf({{"vcm", {0.1, 4, caustic}}, {"bpt", {0.1, 3.9, caustic}}, {"pt", {0.01, 0.1}}}));
    EXPECT_EQ(choice.technique, "vcm");
    EXPECT_TRUE(choice.measures[2].losesLight);
    EXPECT_FALSE(choice.measures[1].losesLight);
    const auto everywhere = [](uint32_t) { return 0.49; };
    EXPECT_EQ(
        choose(test::tinyScene(), pilotOf({{"vcm", {0.1, 4}}, {"bpt", {0.1, 3.9}}, {"pt", {0.01, 0.1, everywhere}}}))
            .technique,
        "vcm");
}

/// As the reflected caustics of Cornell area are in bpt: few pixels of its image, and most of its error.
TEST(TechniqueChoice, DoesNotOverlookTheWorstPixels) {
    FakeTechnique bpt{0.1, 2};
    bpt.rare = [](uint32_t pixel) { return pixel % 1500 == 7 ? 9.0 : 0.0; };
    const TechniqueChoice choice =
        choose(test::tinyScene(), pilotOf({{"vcm", {0.1, 4}}, {"bpt", bpt}, {"pt", {0.4, 4}}}));
    EXPECT_EQ(choice.technique, "vcm");
    EXPECT_LT(choice.measures[1].trimmed * 2, choice.measures[1].variance);
    EXPECT_FALSE(choice.measures[1].losesLight);
}

TEST(TechniqueChoice, LeavesOutWhatIsToBeLeftOut) {
    RenderSettings settings = settingsOf();
    settings.without.add(Transport::Merging);
    settings.without.add(Transport::Connections);
    const TechniqueChoice choice =
        chooseTechnique(test::tinyScene(), settings, pilotOf({{"vcm", {0.1, 4}}, {"bpt", {9, 9}}, {"pt", {0.1, 1}}}));
    EXPECT_EQ(choice.measures.size(), 2u) << "bpt without connections is vcm without them and merging";
    EXPECT_EQ(settings.technique, "pt");
    EXPECT_TRUE(settings.without.empty()) << "pt has neither";
}

TEST(PilotSettings, AreThoseOfASmallImageWithTheSameMerges) {
    RenderSettings settings = settingsOf();
    settings.width = 1024, settings.height = 512;
    settings.initialRadius = 0.25;
    settings.lightPathCount = 77;
    const RenderSettings pilot = pilotSettings(settings);
    EXPECT_EQ(pilot.width, 181u);
    EXPECT_EQ(pilot.height, 90u);
    EXPECT_DOUBLE_EQ(*pilot.initialRadius, 0.25 * 512 / 90);
    EXPECT_FALSE(pilot.lightPathCount);
    settings.width = settings.height = 20;
    EXPECT_EQ(pilotSettings(settings).width, 20u);
}

}  // namespace
}  // namespace antipode
