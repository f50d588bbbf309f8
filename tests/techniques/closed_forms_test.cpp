// Renders against closed forms, every technique.
//
// Statistics. One iteration's mean over a block of pixels is one sample; iterations are independent (their pixels are
// not: merging shares photons). Null hypothesis of every test: the expectation lies within the technique's known bias
// of the closed form (1e-6 of it for float32's rounding). Student's t over kIterations iterations, α = .01 over all
// tests of the table (Šidák), for each precision, seed 7. Merging's bias is bounded from the closed form's curvature,
// and the bound must stay below half a standard error or below 2e-3; the standard error of a whole image must stay
// below 3 %: a test that says nothing fails.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "support/closed_forms.h"
#include "support/worst.h"
#include "tests/techniques/closed_form_case.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

constexpr uint64_t kIterations = 32;

uint64_t testsInTable() {
    uint64_t tests = 0;
    for (const ClosedFormCase& c : closedFormCases())
        tests += blocksOf(c.size, c.size, c.blocks, c.blocks).size() *
                 (techniqueTable().size() - c.blind.size() - c.heavyTailed.size());
    return tests;
}

bool merges(const std::string& technique) { return technique == "vcm" || technique == "bpm" || technique == "ppm"; }

/// A row of the table and the kernels' precision.
class EngineClosedForm : public EngineTest, public testing::WithParamInterface<std::tuple<size_t, Precision>> {
protected:
    void expectBlack(const ClosedFormCase& c, const RenderSettings& settings) {
        const FilmSums sums = renderSums(c.scene, settings, {1, 2});
        EXPECT_TRUE(std::all_of(sums.values.begin(), sums.values.end(), [](int64_t v) { return v == 0; }));
    }

    void expectClosedForm(const ClosedFormCase& c, const RenderSettings& settings) {
        const std::vector<Image> images = renderEach(c.scene, settings, kIterations);
        Worst surprise;
        bool whole = true;
        for (const Block& b : blocksOf(c.size, c.size, c.blocks, c.blocks)) {
            const ExpectedBlock expected = expectedOf(c, b.left, b.top, b.right, b.bottom);
            const double bias = (merges(settings.technique) ? expected.mergeBias : 0) + 1e-6 * expected.radiance;
            const Moments moments = momentsOf(images, b, 1);
            const double error = std::sqrt(moments.meanVariance());
            const double nearest = std::clamp(moments.mean(), expected.radiance - bias, expected.radiance + bias);
            std::ostringstream said;
            said << "block " << b.left << "," << b.top << ": " << moments.mean() << " ± " << error << " instead of "
                 << expected.radiance << " (bias up to " << bias << "), ratio " << moments.mean() / expected.radiance;
            surprise.add(-std::log10(tTest(moments, nearest).pValue), said.str());
            if (whole) {
                expectWithin({"Closed forms", c.difficulty, "relative standard error of the image's mean", 0.03},
                             error / expected.radiance, deviceName(), settings.precision);
                EXPECT_LE(bias, std::max(0.5 * error, 2e-3 * expected.radiance));
            }
            whole = false;
        }
        SCOPED_TRACE(surprise.where);
        const double bound = -std::log10(sidak(kAlpha, testsInTable()));
        expectWithin({"Closed forms", c.difficulty, "largest −log₁₀ p of t-tests over blocks and techniques", bound},
                     surprise.value, deviceName(), settings.precision);
    }
};

TEST_P(EngineClosedForm, HoldsForEveryTechnique) {
    const ClosedFormCase& c = closedFormCases()[std::get<size_t>(GetParam())];
    for (const TechniqueInfo& technique : techniqueTable()) {
        SCOPED_TRACE(technique.name);
        if (std::ranges::count(c.heavyTailed, technique.name) > 0) continue;
        RenderSettings settings = settingsOf(c);
        settings.precision = std::get<Precision>(GetParam());
        settings.technique = technique.name;
        const bool blind = std::find(c.blind.begin(), c.blind.end(), technique.name) != c.blind.end();
        blind ? expectBlack(c, settings) : expectClosedForm(c, settings);
    }
}

const auto kRows = testing::Range<size_t>(0, closedFormCases().size());
const auto kNameOfRow = [](const auto& row) { return closedFormCases()[std::get<size_t>(row.param)].name; };
INSTANTIATE_TEST_SUITE_P(Float, EngineClosedForm, testing::Combine(kRows, testing::Values(Precision::Float)),
                         kNameOfRow);
INSTANTIATE_TEST_SUITE_P(Double, EngineClosedForm, testing::Combine(kRows, testing::Values(Precision::Double)),
                         kNameOfRow);

// --- One pixel ---

class EngineOnePixel : public EngineTest, public testing::WithParamInterface<Precision> {};

/// An image of one pixel, with one light path an iteration (light tracing: 512, since most miss the pixel). t-tests on
/// 600 iterations, α = .01 over five techniques (Šidák), seed 7.
TEST_P(EngineOnePixel, AndOneLightPathAreEnough) {
    const auto named = [](const ClosedFormCase& c) { return c.name == "RectangleLightAboveCentre"; };
    ClosedFormCase c = *std::find_if(closedFormCases().begin(), closedFormCases().end(), named);
    c.size = 1;
    const double expected = expectedOf(c, 0, 0, 1, 1).radiance;
    for (const char* technique : {"pt", "pt-naive", "lt", "bpt", "vcm"}) {
        RenderSettings settings = settingsOf(c);
        settings.technique = technique;
        settings.precision = GetParam();
        settings.lightPathCount = settings.technique == "lt" ? 512 : 1;
        const Moments moments = momentsOf(renderEach(c.scene, settings, 600), {0, 0, 1, 1}, 0);
        const double error = std::sqrt(moments.meanVariance());
        SCOPED_TRACE(testing::Message() << technique << " " << moments.mean() << " ± " << error << " instead of "
                                        << expected);
        expectWithin({"Images", "1 × 1 pixels, one light path an iteration",
                      "largest −log₁₀ p of t-tests over techniques", -std::log10(sidak(kAlpha, 5))},
                     -std::log10(tTest(moments, expected).pValue), deviceName(), GetParam());
        EXPECT_LT(error, 0.1 * expected);
    }
}

INSTANTIATE_TEST_SUITE_P(In, EngineOnePixel, testing::Values(Precision::Float, Precision::Double), precisionName);

// --- Without variance: nothing but specular surfaces and emission, no roulette ---

class EngineSpecularClosedForm : public EngineTest, public testing::WithParamInterface<Precision> {
protected:
    /// Every pixel of one iteration, under every technique. Float32 rounds a path of some ten vertices to about 1e-6;
    /// in double the image's own floats are left.
    void expectEverywhere(const Scene& scene, uint32_t maxPathLength, double expected, const std::string& group,
                          const std::string& difficulty) {
        const double bound = GetParam() == Precision::Double ? 1e-6 : 1e-5;
        for (const TechniqueInfo& technique : techniqueTable()) {
            SCOPED_TRACE(technique.name);
            RenderSettings settings;
            settings.width = settings.height = 16;
            settings.technique = technique.name;
            settings.russianRoulette = false;
            settings.maxPathLength = maxPathLength;
            settings.precision = GetParam();
            Worst error;
            for (const Image& image : renderEach(scene, settings, 2))
                for (const Vec3f& pixel : image.pixels) error.add(std::abs(double(pixel.y) / expected - 1));
            expectWithin({group, difficulty, "largest relative error of a pixel, all techniques", bound}, error.value,
                         deviceName(), GetParam());
        }
    }
};

Scene glassBallInFurnace() {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addGlass(scene)});
    setConstantSky(scene, Vec3f(1.0f));
    return scene;
}

/// 400 edges: a longer path has reflected inside the ball 398 times, with a chance of (1−R)R^398. That is below 1e-3 at
/// the worst impact parameter and negligible (R < .99) but for those within 1e-5 of the silhouette.
TEST_P(EngineSpecularClosedForm, GlassIsInvisibleInAFurnace) {
    Scene scene = glassBallInFurnace();
    scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.45);
    expectEverywhere(scene, 400, 1, "Long paths", "lossless glass in uniform light, up to 400 edges");
}

TEST_P(EngineSpecularClosedForm, RadianceInsideGlassIsScaled) {
    Scene scene = glassBallInFurnace();
    scene.camera = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.8);
    expectEverywhere(scene, 400, closed_forms::radianceInsideGlass(1.5, 1), "Closed forms",
                     "radiance inside glass is n² times that outside");
}

TEST_P(EngineSpecularClosedForm, FacingMirrorsBounceByBounce) {
    Scene scene;
    const uint32_t mirror = addMirror(scene, 0.75f, 2);
    addHorizontalSquare(scene, {0, 0, 1}, 10, mirror, false);
    addHorizontalSquare(scene, {0, 0, -1}, 10, mirror);
    scene.camera = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.2);
    for (const uint32_t bounces : {0u, 1u, 10u}) {
        SCOPED_TRACE(bounces);
        expectEverywhere(scene, bounces + 1, closed_forms::facingMirrors(2, 0.75, bounces), "Long paths",
                         "glowing mirrors that face each other, bounce by bounce");
    }
}

/// The same with roulette, which lets glass paths end with a chance of 2 % a vertex from the third on: t-test, α = .01,
/// seed 1. Few paths come so far and fewer end: it takes 256 iterations for their mean to be distributed normally.
TEST_P(EngineSpecularClosedForm, RouletteKeepsTheMeanOfGlass) {
    Scene scene = glassBallInFurnace();
    scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.45);
    RenderSettings settings;
    settings.width = settings.height = 32;
    settings.technique = "pt";
    settings.precision = GetParam();
    const Moments moments = momentsOf(renderEach(scene, settings, 256), {0, 0, 32, 32}, 1);
    SCOPED_TRACE(testing::Message() << moments.mean() << " ± " << std::sqrt(moments.meanVariance()));
    expectWithin({"Long paths", "paths through glass that roulette ends", "−log₁₀ p of a t-test", -std::log10(kAlpha)},
                 -std::log10(tTest(moments, 1).pValue), deviceName(), GetParam());
    EXPECT_GT(moments.meanVariance(), 0) << "no roulette took place";
}

INSTANTIATE_TEST_SUITE_P(In, EngineSpecularClosedForm, testing::Values(Precision::Float, Precision::Double),
                         precisionName);

}  // namespace
}  // namespace antipode::test
