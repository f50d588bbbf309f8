// Glass that disperses light: where each wavelength goes, and that none is lost.
#include <algorithm>
#include <cmath>

#include "renderengine/error.h"
#include "support/hard_case.h"
#include "support/worst.h"
#include "techniques/wavelength.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

constexpr float kAbbeNumber = 10;

uint32_t addDispersiveGlass(Scene& scene) {
    const uint32_t glass = addGlass(scene);
    scene.materials[glass].abbeNumber = kAbbeNumber;
    return glass;
}

class EngineDispersion : public EngineTest, public testing::WithParamInterface<Precision> {
protected:
    static RenderSettings smallImage(const std::string& technique) {
        RenderSettings settings;
        settings.width = settings.height = 16;
        settings.technique = technique;
        settings.russianRoulette = false;
        settings.maxPathLength = 400;
        settings.precision = GetParam();
        return settings;
    }

    /// Every pixel of each iteration has the colour of its wavelength times `expected` of that index.
    template <class Expected>
    void expectEverywhere(const Scene& scene, const std::string& difficulty, const Expected& expected) {
        const double bound = GetParam() == Precision::Double ? 1e-6 : 1e-5;
        for (const TechniqueInfo& technique : techniqueTable()) {
            SCOPED_TRACE(technique.name);
            const RenderSettings settings = smallImage(technique.name);
            const std::vector<Image> images = renderEach(scene, settings, 3);
            Worst error;
            for (size_t i = 0; i < images.size(); ++i) {
                const Wavelength w = wavelengthOf(settings.seed, i + 1);
                const double radiance = expected(1.5 + 0.5 / double(kAbbeNumber) * w.dispersion);
                for (const Vec3f& pixel : images[i].pixels)
                    for (int c = 0; c < 3; ++c)
                        error.add(std::abs(double(pixel[c]) - w.response[c] * radiance) / radiance);
            }
            expectWithin(
                {"Closed forms", difficulty, "largest error of a pixel, all techniques, a wavelength each", bound},
                error.value, deviceName(), GetParam());
        }
    }
};

/// A ball that fills the view cannot be seen at any wavelength but for the wavelength's colour.
TEST_P(EngineDispersion, GlassLosesNoColourInAFurnace) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addDispersiveGlass(scene)});
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.3);
    expectEverywhere(scene, "glass that disperses uniform light", [](double) { return 1.0; });
}

/// Seen from inside, radiance is n² times that outside, n of the wavelength; and so it is where a ball of water and a
/// ball of the same glass are in the glass.
TEST_P(EngineDispersion, RadianceInsideGoesByTheIndexOfTheWavelength) {
    Scene scene;
    const uint32_t glass = addDispersiveGlass(scene), water = addGlass(scene, 1.33f);
    scene.spheres.push_back({{0, 0, 0}, 1, glass});
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.8);
    const auto squared = [](double index) { return index * index; };
    expectEverywhere(scene, "radiance inside glass that disperses", squared);
    scene.spheres.push_back({{0.1f, 0, 0.4f}, 0.1f, water});
    scene.spheres.push_back({{-0.1f, 0, 0.4f}, 0.09f, glass});
    expectEverywhere(scene, "water and glass in glass that disperses", squared);
}

/// What meets no such glass has no colour: one iteration is as grey as all.
TEST_P(EngineDispersion, WhatMeetsNoSuchGlassKeepsItsColour) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addDispersiveGlass(scene)});
    addHorizontalSquare(scene, {5, 0, 0}, 1, addLambert(scene, Vec3f(0.5f)));
    addPointLight(scene, {5, 0, 1}, Vec3f(1.0f));
    scene.camera = lookAt({5, 0, 2}, {5, 0, 0}, {0, 1, 0}, 0.4);
    for (const char* technique : {"pt", "lt", "bpt", "vcm"}) {
        SCOPED_TRACE(technique);
        RenderSettings settings = smallImage(technique);
        settings.maxPathLength = 2;
        double sum = 0;
        for (const Image& image : renderEach(scene, settings, 2))
            for (const Vec3f& pixel : image.pixels) {
                EXPECT_EQ(pixel.x, pixel.y);
                EXPECT_EQ(pixel.x, pixel.z);
                sum += double(pixel.x);
            }
        EXPECT_GT(sum, 0);
    }
}

/// A light vertex keeps its path's length and what it has met in 16 bits.
TEST_F(EngineTest, PathsAreShorterWhereGlassDisperses) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addDispersiveGlass(scene)});
    setConstantSky(scene, Vec3f(1.0f));
    RenderSettings settings;
    settings.width = settings.height = 4;
    settings.maxPathLength = 32768;
    EXPECT_THROW(Engine(scene, settings), Error);
    settings.maxPathLength = 32767;
    EXPECT_NO_THROW(Engine(scene, settings));
}

// --- A prism ---

/// Sunlight straight down into the level top of a wedge, −.2 ≤ x ≤ .2, out through its bottom, which rises with x by
/// the angle kWedge: the index n bends it by asin(n·sin kWedge) − kWedge towards −x. The floor is at z = 0, black but
/// for a thousandth.
constexpr double kWedge = 0.5, kHalfWidth = 0.2, kHeight = 1, kTop = 1.3;

Scene prismScene() {
    Scene scene;
    addHorizontalSquare(scene, {-0.3f, 0, 0}, 0.6f, addLambert(scene, Vec3f(0.001f)));
    Mesh prism;
    prism.material = addDispersiveGlass(scene);
    const float x = float(kHalfWidth), rise = float(kHalfWidth * std::tan(kWedge)), y = 0.4f;
    for (const float side : {-y, y}) {
        prism.positions.push_back({-x, side, float(kHeight) - rise});
        prism.positions.push_back({x, side, float(kHeight) + rise});
        prism.positions.push_back({x, side, float(kTop)});
        prism.positions.push_back({-x, side, float(kTop)});
    }
    prism.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t next = (i + 1) % 4;
        prism.triangles.push_back({i, 4 + next, next});
        prism.triangles.push_back({i, 4 + i, 4 + next});
    }
    scene.meshes.push_back(std::move(prism));
    scene.directionalLights.push_back({{0, 0, -1}, Vec3f(1000.0f)});
    return scene;
}

/// Where the light of index n arrives, on average over its patch: the mean over the exit face of x − z·tan δ.
double arrival(double n) {
    const double deviation = std::asin(n * std::sin(kWedge)) - kWedge;
    return -kHeight * std::tan(deviation);
}

/// Snell's law with n(λ), by the centre of the patch that each iteration's light makes: paths of exactly four edges,
/// lamp, top, bottom, floor, camera. Null hypothesis: the error of the centre has mean 0, and its product with how far
/// the wavelength is from d, so that neither n_d nor the Abbe number is off. t-tests over 32 iterations, α = .01 over
/// all of a precision (Šidák), seed 1.
TEST_P(EngineDispersion, PrismBendsEachWavelengthBySnellsLaw) {
    Scene scene = prismScene();
    const double middle = arrival(1.5), halfWidth = 0.5;
    scene.camera = lookDownOn(middle, 0, 0.5, halfWidth);
    const double spread = std::abs(arrival(1.5 + 0.5 / double(kAbbeNumber)) - middle);
    for (const char* technique : {"lt", "bpt", "bpm", "vcm"}) {
        SCOPED_TRACE(technique);
        RenderSettings settings;
        settings.width = settings.height = 50;
        settings.technique = technique;
        settings.minPathLength = settings.maxPathLength = 4;
        settings.lightPathCount = 100000;
        settings.initialRadius = 0.01;
        settings.alpha = 1;
        settings.precision = GetParam();
        const std::vector<Image> images = renderEach(scene, settings, 32);
        Moments offset, slope;
        Worst colour;
        for (size_t i = 0; i < images.size(); ++i) {
            const Wavelength w = wavelengthOf(settings.seed, i + 1);
            double sum = 0, first = 0;
            for (uint32_t row = 0; row < 50; ++row)
                for (uint32_t column = 0; column < 50; ++column) {
                    const Vec3d pixel(images[i].pixels[row * 50 + column]);
                    const double seen = (pixel.x + pixel.y + pixel.z) / 3;
                    if (seen == 0) continue;
                    sum += seen;
                    first += seen * (middle + ((column + 0.5) / 25.0 - 1) * halfWidth);
                    for (int c = 0; c < 3; ++c) colour.add(std::abs(pixel[c] / seen - w.response[c]));
                }
            ASSERT_GT(sum, 0);
            const double error = first / sum - arrival(1.5 + 0.5 / double(kAbbeNumber) * w.dispersion);
            offset.add(error);
            slope.add(error * w.dispersion);
        }
        SCOPED_TRACE(testing::Message() << "offset " << offset.mean() << " ± " << std::sqrt(offset.meanVariance())
                                        << ", by dispersion " << slope.mean() << " ± "
                                        << std::sqrt(slope.meanVariance()) << "; a unit of it moves by " << spread);
        const double surprise = -std::log10(std::min(tTest(offset, 0).pValue, tTest(slope, 0).pValue));
        expectWithin({"Closed forms", "a prism bends sunlight by the index of each wavelength",
                      "largest −log₁₀ p of t-tests over techniques", -std::log10(sidak(kAlpha, 8))},
                     surprise, deviceName(), GetParam());
        EXPECT_LT(std::sqrt(slope.meanVariance()), 0.02 * spread) << "says nothing";
        expectWithin({"Closed forms", "a prism bends sunlight by the index of each wavelength",
                      "largest difference of a pixel's colour from its wavelength's", 1e-4},
                     colour.value, deviceName(), GetParam());
    }
}

INSTANTIATE_TEST_SUITE_P(In, EngineDispersion, testing::Values(Precision::Float, Precision::Double), precisionName);

}  // namespace
}  // namespace antipode::test
