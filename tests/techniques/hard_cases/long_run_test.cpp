// A hundred thousand iterations, rendered: the mean stays right while the merge radius shrinks, and the sums stay
// exact.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "support/closed_forms.h"
#include "tests/techniques/differing_sums.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

constexpr uint64_t kIterations = 100'000, kBatch = 1000;

class RenderedLongRun : public HardCaseTest {
protected:
    /// A floor under a lamp of 2 × 2 at the height 1, seen to ±w at its centre. The validation layer, which has seen
    /// the like in every other test, would take longer than the render.
    RenderedLongRun() {
        setenv("ANTIPODE_VALIDATION", "0", 1);
        addHorizontalSquare(scene, {0, 0, 0}, 0.75f, addLambert(scene, Vec3f(0.5f)));
        addHorizontalSquare(scene, {0, 0, 1}, 1, addLamp(scene, Vec3f(1.0f)), false);
        scene.camera = lookDownOn(0, 0, 0.5, w);
        settings.width = settings.height = 4;
        settings.lightPathCount = 16;
        settings.initialRadius = 0.05;
        settings.maxPathLength = 2;
    }

    static double closedForm() {
        constexpr int steps = 64;
        double sum = 0;
        for (int i = 0; i < steps * steps; ++i) {
            const double x = w * (2 * (i % steps + 0.5) / steps - 1), y = w * (2 * (i / steps + 0.5) / steps - 1);
            const auto corner = closed_forms::formFactorUnderCorner;
            sum +=
                corner(1 - x, 1 - y, 1) + corner(1 + x, 1 - y, 1) + corner(1 - x, 1 + y, 1) + corner(1 + x, 1 + y, 1);
        }
        return 0.5 * sum / (steps * steps);
    }

    static constexpr double w = 0.25;
    Scene scene;
    RenderSettings settings;
};

// Null hypothesis: the expectation of the mean of the image is the closed form's, but for merging's bias, below 1e-5 of
// it: r²/8·|∇²L|/L ≤ r² would be 8e-5 with the mean of the shrinking r², 1.5·N^(-1/3) of the first, and merges have
// less than a tenth of the weight. Student's t on batches of 1000 iterations, seed 1, α = .01. And the sums of the two
// halves, the second one rendered by another engine, add up to those of the whole, to the last bit.
TEST_F(RenderedLongRun, MeanIsRightAndSumsAreExact) {
    Engine engine(scene, settings);
    FilmSums before, half;
    Moments batches;
    const double unit = std::ldexp(1.0, -engine.sums().layout.layers[0].scaleExponent);
    for (uint64_t i = 1; i <= kIterations; ++i) {
        engine.render(i);
        if (i % kBatch != 0) continue;
        const FilmSums sums = engine.sums();
        int64_t batch = 0;
        for (size_t at = 1; at < sums.values.size(); at += 3)
            batch += sums.values[at] - (before.values.empty() ? 0 : before.values[at]);
        batches.add(double(batch) * unit / (16.0 * kBatch));
        if (i == kIterations / 2) half = sums;
        before = sums;
    }
    expectHealthy(engine);
    const double expected = closedForm(), error = std::sqrt(batches.meanVariance());
    EXPECT_LE(error, 1e-3 * expected);
    const double bias = 1e-5 * expected, nearest = std::clamp(batches.mean(), expected - bias, expected + bias);
    SCOPED_TRACE(testing::Message() << batches.mean() << " ± " << error << " instead of " << expected);
    expectMeasured({"Accumulation", "10^5 iterations of vcm with a shrinking radius",
                    "−log₁₀ p of a t-test of their mean", -std::log10(kAlpha)},
                   -std::log10(tTest(batches, nearest).pValue));

    Engine other(scene, settings);
    for (uint64_t i = kIterations / 2 + 1; i <= kIterations; ++i) other.render(i);
    half.merge(other.sums());
    expectMeasured({"Accumulation", "10^5 iterations in two halves, added", "differing sums", 0},
                   differingSums(half, engine.sums()));
}

}  // namespace
}  // namespace antipode::test
