// What a render does after a million iterations, without rendering them: an iteration is a function of its number.
#include <cmath>

#include "proto/scene_loader.h"
#include "support/worst.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

TEST(RadiusSchedule, ShrinksByTheLawForTenMillionIterations) {
    const double first = 0.01, alpha = 2.0 / 3.0;
    double before = mergeRadius(first, alpha, 1);
    EXPECT_EQ(before, first);
    for (uint64_t i = 2; i <= 10'000'000; ++i) {
        const double radius = mergeRadius(first, alpha, i);
        ASSERT_LT(radius, before) << i;
        before = radius;
    }
    const double expected = first * std::pow(1e7, -1.0 / 6.0);
    expectWithin(
        {"Merging", "the radius shrinks strictly, ten million times", "relative error of the last radius", 1e-13},
        std::abs(before / expected - 1), "host", Precision::Double);
}

class EngineLongRun : public EngineTest, public testing::WithParamInterface<uint64_t> {};

// Null hypothesis: late iterations of VCM, whose merge radius is almost 0, have the expectation of bidirectional path
// tracing, which has no merging and no bias: the whole image and four blocks, 24 iterations each, seed 1, α = .01.
TEST_P(EngineLongRun, LateIterationsAreHealthyAndUnbiased) {
    const Scene scene = loadScene(ANTIPODE_SOURCE_DIR "/scenes/cornell/point.textproto");
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    settings.maxPathLength = 3;  // what both sample: nothing is seen through glass twice
    constexpr uint64_t iterations = 24;
    for (const Precision precision : {Precision::Float, Precision::Double}) {
        settings.precision = precision;
        settings.technique = "vcm";
        settings.seed = 1;
        const auto late = renderEach(scene, settings, iterations, GetParam());
        settings.technique = "bpt";
        settings.seed = 2;
        const auto unbiased = renderEach(scene, settings, iterations);
        const std::vector<Block> blocks = blocksOf(settings.width, settings.height, 2, 2);
        Worst surprise;
        for (const Block& block : blocks)
            surprise.add(-std::log10(welchTest(momentsOf(late, block, 1), momentsOf(unbiased, block, 1)).pValue));
        expectWithin({"Merging", "iterations from 10⁶, 10⁸ and 10¹² on, whose radius is almost 0, against BPT",
                      "largest −log₁₀ p of Welch tests over blocks", -std::log10(sidak(kAlpha, 3 * blocks.size()))},
                     surprise.value, deviceName(), precision);
    }
}

// 10^12: the number no longer fits in 32 bits.
INSTANTIATE_TEST_SUITE_P(From, EngineLongRun, testing::Values(1'000'000, 100'000'000, 1'000'000'000'000),
                         [](const auto& first) { return std::to_string(first.param); });

}  // namespace
}  // namespace antipode::test
