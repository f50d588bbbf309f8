// Renders against closed forms, every technique.
//
// Statistics. One iteration's mean over a block of pixels is one sample; iterations are independent (their pixels are
// not: merging shares photons). Null hypothesis of every test: the expectation lies within the technique's known bias
// of the closed form (1e-6 of it for float32's rounding). Student's t over kIterations iterations, α = .01 over all
// tests of the table (Šidák), seed 7. Merging's bias is bounded from the closed form's curvature, and the bound must
// stay below half a standard error or below 2e-3; the standard error of a whole image must stay below 3 %: a test that
// says nothing fails.
#include <algorithm>
#include <cmath>

#include "support/closed_forms.h"
#include "tests/techniques/closed_form_case.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

constexpr uint64_t kIterations = 32;

uint64_t testsInTable() {
    uint64_t tests = 0;
    for (const ClosedFormCase& c : closedFormCases())
        tests += blocksOf(c.size, c.size, c.blocks, c.blocks).size() * (techniqueTable().size() - c.blind.size());
    return tests;
}

bool merges(const std::string& technique) { return technique == "vcm" || technique == "bpm" || technique == "ppm"; }

class EngineClosedForm : public EngineTest, public testing::WithParamInterface<size_t> {
protected:
    void expectBlack(const ClosedFormCase& c, const RenderSettings& settings) {
        const FilmSums sums = renderSums(c.scene, settings, {1, 2});
        EXPECT_TRUE(std::all_of(sums.rgb.begin(), sums.rgb.end(), [](int64_t v) { return v == 0; }));
    }

    void expectClosedForm(const ClosedFormCase& c, const RenderSettings& settings) {
        const std::vector<Image> images = renderEach(c.scene, settings, kIterations);
        const double significance = sidak(kAlpha, testsInTable());
        bool whole = true;
        for (const Block& b : blocksOf(c.size, c.size, c.blocks, c.blocks)) {
            const ExpectedBlock expected = expectedOf(c, b.left, b.top, b.right, b.bottom);
            const double bias = (merges(settings.technique) ? expected.mergeBias : 0) + 1e-6 * expected.radiance;
            const Moments moments = momentsOf(images, b, 1);
            const double error = std::sqrt(moments.meanVariance());
            const double nearest = std::clamp(moments.mean(), expected.radiance - bias, expected.radiance + bias);
            EXPECT_GT(tTest(moments, nearest).pValue, significance)
                << "block " << b.left << "," << b.top << ": " << moments.mean() << " ± " << error << " instead of "
                << expected.radiance << " (bias up to " << bias << "), ratio " << moments.mean() / expected.radiance;
            if (whole) {
                EXPECT_LE(error, 0.03 * expected.radiance);
                EXPECT_LE(bias, std::max(0.5 * error, 2e-3 * expected.radiance));
            }
            whole = false;
        }
    }
};

TEST_P(EngineClosedForm, HoldsForEveryTechnique) {
    const ClosedFormCase& c = closedFormCases()[GetParam()];
    for (const TechniqueInfo& technique : techniqueTable()) {
        SCOPED_TRACE(technique.name);
        RenderSettings settings = settingsOf(c);
        settings.technique = technique.name;
        const bool blind = std::find(c.blind.begin(), c.blind.end(), technique.name) != c.blind.end();
        blind ? expectBlack(c, settings) : expectClosedForm(c, settings);
    }
}

INSTANTIATE_TEST_SUITE_P(Table, EngineClosedForm, testing::Range<size_t>(0, closedFormCases().size()),
                         [](const auto& row) { return closedFormCases()[row.param].name; });

// --- One pixel ---

class EngineOnePixel : public EngineTest {};

/// An image of one pixel, with one light path an iteration (light tracing: 512, since most miss the pixel). t-tests on
/// 600 iterations, α = .01 over five techniques (Šidák), seed 7.
TEST_F(EngineOnePixel, AndOneLightPathAreEnough) {
    const auto named = [](const ClosedFormCase& c) { return c.name == "RectangleLightAboveCentre"; };
    ClosedFormCase c = *std::find_if(closedFormCases().begin(), closedFormCases().end(), named);
    c.size = 1;
    const double expected = expectedOf(c, 0, 0, 1, 1).radiance;
    for (const char* technique : {"pt", "pt-naive", "lt", "bpt", "vcm"}) {
        RenderSettings settings = settingsOf(c);
        settings.technique = technique;
        settings.lightPathCount = settings.technique == "lt" ? 512 : 1;
        const Moments moments = momentsOf(renderEach(c.scene, settings, 600), {0, 0, 1, 1}, 0);
        const double error = std::sqrt(moments.meanVariance());
        EXPECT_GT(tTest(moments, expected).pValue, sidak(kAlpha, 5))
            << technique << " " << moments.mean() << " ± " << error << " instead of " << expected;
        EXPECT_LT(error, 0.1 * expected) << technique;
    }
}

// --- Without variance: nothing but specular surfaces and emission, no roulette ---

class EngineSpecularClosedForm : public EngineTest {
protected:
    /// Every pixel of one iteration, under every technique. Float32 rounds a path of some ten vertices to about 1e-6.
    void expectEverywhere(const Scene& scene, uint32_t maxPathLength, double expected) {
        for (const TechniqueInfo& technique : techniqueTable()) {
            SCOPED_TRACE(technique.name);
            RenderSettings settings;
            settings.width = settings.height = 16;
            settings.technique = technique.name;
            settings.russianRoulette = false;
            settings.maxPathLength = maxPathLength;
            for (const Image& image : renderEach(scene, settings, 2))
                for (const Vec3f& pixel : image.pixels) EXPECT_NEAR(double(pixel.y) / expected, 1, 1e-5);
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
TEST_F(EngineSpecularClosedForm, GlassIsInvisibleInAFurnace) {
    Scene scene = glassBallInFurnace();
    scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.45);
    expectEverywhere(scene, 400, 1);
}

TEST_F(EngineSpecularClosedForm, RadianceInsideGlassIsScaled) {
    Scene scene = glassBallInFurnace();
    scene.camera = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.8);
    expectEverywhere(scene, 400, closed_forms::radianceInsideGlass(1.5, 1));
}

TEST_F(EngineSpecularClosedForm, FacingMirrorsBounceByBounce) {
    Scene scene;
    const uint32_t mirror = addMirror(scene, 0.75f, 2);
    addHorizontalSquare(scene, {0, 0, 1}, 10, mirror, false);
    addHorizontalSquare(scene, {0, 0, -1}, 10, mirror);
    scene.camera = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.2);
    for (const uint32_t bounces : {0u, 1u, 10u}) {
        SCOPED_TRACE(bounces);
        expectEverywhere(scene, bounces + 1, closed_forms::facingMirrors(2, 0.75, bounces));
    }
}

/// The same with roulette, which lets glass paths end with a chance of 2 % a vertex: t-test, α = .01, seed 1.
TEST_F(EngineSpecularClosedForm, RouletteKeepsTheMeanOfGlass) {
    Scene scene = glassBallInFurnace();
    scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.45);
    RenderSettings settings;
    settings.width = settings.height = 32;
    settings.technique = "pt";
    const Moments moments = momentsOf(renderEach(scene, settings, kIterations), {0, 0, 32, 32}, 1);
    EXPECT_GT(tTest(moments, 1).pValue, kAlpha) << moments.mean() << " ± " << std::sqrt(moments.meanVariance());
    EXPECT_GT(moments.meanVariance(), 0) << "no roulette took place";
}

}  // namespace
}  // namespace antipode::test
