// Materials at the ends of their parameters, in furnaces.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "support/closed_forms.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Sampling";

std::string text(const char* format, double v) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, v);
    return buffer;
}
std::string codeName(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '.' || c == '-' || c == '+'; }, '_');
    return name;
}

class Ior : public HardCaseTest, public testing::WithParamInterface<double> {};

/// A ball of smooth, lossless glass is invisible: 400 edges leave less than 1e-5 of its inner reflections.
TEST_P(Ior, SmoothGlassIsInvisibleInAFurnace) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addGlass(scene, float(GetParam()))});
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.45);
    RenderSettings settings = smallImage(16, 0.1);
    settings.russianRoulette = false;
    settings.maxPathLength = 400;
    double worst = 0;
    for (const char* technique : {"pt", "vcm", "bpm"}) {
        settings.technique = technique;
        for (const Image& image : samplesOf(scene, settings, 2))
            for (const Vec3f& pixel : image.pixels) worst = std::max(worst, std::abs(double(pixel.y) - 1));
    }
    expectMeasured(
        {kGroup, "smooth glass of ior " + text("%g", GetParam()) + " in a furnace", "largest error of a pixel", 1e-5},
        worst);
}

/// Rough glass loses what would scatter twice between its facets and never gains. Nearly equal indices hardly turn the
/// light, so that the loss is that of the shadowing alone; measured is what is above 1.
TEST_P(Ior, RoughGlassCreatesNoLight) {
    double excess = -std::numeric_limits<double>::infinity();
    for (const float roughness : {0.05f, 0.3f, 1.0f}) {
        Scene scene;
        const uint32_t glass = addMaterial(scene, MaterialKind::RoughDielectric, Vec3f(1.0f), roughness);
        scene.materials[glass].ior = float(GetParam());
        scene.spheres.push_back({{0, 0, 0}, 1, glass});
        setConstantSky(scene, Vec3f(1.0f));
        scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.45);
        RenderSettings settings = smallImage(16, 0.1);
        settings.russianRoulette = false;
        settings.maxPathLength = 30;
        std::optional<Moments> first;
        for (const char* technique : {"pt", "pt-naive", "vcm"}) {
            settings.technique = technique;
            settings.seed++;
            const Moments moments = momentsOf(samplesOf(scene, settings, 16), {0, 0, 16, 16}, 1);
            if (!first) first = moments;
            const double error = std::sqrt(moments.meanVariance());
            EXPECT_LE(error, 0.05 * moments.mean()) << technique << ", roughness " << roughness;
            EXPECT_GE(welchTest(moments, *first).pValue, sidak(kAlpha, 6)) << technique << ", roughness " << roughness;
            excess = std::max(excess, (moments.mean() - 1) / std::max(error, 1e-6));
        }
    }
    expectMeasured({kGroup, "rough glass of ior " + text("%g", GetParam()) + " in a furnace",
                    "greatest excess over 1 of 9 means, in standard errors", 3.3},
                   excess);
}

INSTANTIATE_TEST_SUITE_P(Of, Ior, testing::Values(1.0, 1.0001, 1.5),
                         [](const auto& ior) { return codeName(text("%g", ior.param)); });

/// A plane under a uniform sky from 20 away, at the cosine μ of the view.
MeanCase planeUnderSky(const std::string& difficulty, double cosine, const Material& material) {
    MeanCase c{.group = kGroup, .difficulty = difficulty};
    c.scene.materials.push_back(material);
    addHorizontalSquare(c.scene, {0, 0, 0}, 2, 0);
    setConstantSky(c.scene, Vec3f(1.0f));
    const double sine = std::sqrt(1 - cosine * cosine);
    c.scene.camera = lookAt(Vec3f(Vec3d(0, -20 * sine, 20 * cosine)), {0, 0, 0}, {1, 0, 0}, 0.01 * cosine);
    c.settings = smallImage(16, 0.001);
    c.settings.lightPathCount = 1024;
    c.techniques = {"pt", "pt-naive", "bpt", "vcm"};
    return c;
}

struct GgxCase {
    double alpha, cosine;
};

/// A perfect GGX reflector (index 0 + i) shows its single-scattering albedo; α just above what counts as smooth, too.
class Ggx : public HardCaseTest, public testing::WithParamInterface<GgxCase> {};
TEST_P(Ggx, AlbedoIsTheClosedForm) {
    const auto [alpha, cosine] = GetParam();
    Material metal;
    metal.kind = MaterialKind::RoughConductor;
    metal.roughness = float(std::sqrt(alpha));
    metal.conductorEta = Vec3f(0.0f);
    metal.conductorK = Vec3f(1.0f);
    MeanCase c =
        planeUnderSky("GGX of α " + text("%g", alpha) + " seen at a cosine of " + text("%g", cosine), cosine, metal);
    c.settings.width = c.settings.height = 32;
    c.bias = 1e-4;  // of a view whose cosine varies over the image
    // What the narrowest lobe loses is below 1e-5, and too narrow for the closed form's quadrature.
    expectMean(c, alpha < 1e-3 ? 1 : closed_forms::ggxSingleScatterAlbedo(alpha, cosine));
}
INSTANTIATE_TEST_SUITE_P(
    Of, Ggx, testing::Values(GgxCase{1.1e-4, 1}, GgxCase{1.1e-4, 0.1}, GgxCase{0.1, 0.01}, GgxCase{1, 0.01}),
    [](const auto& g) { return codeName(text("Alpha%g", g.param.alpha) + text("Cosine%g", g.param.cosine)); });

/// Seen head on, modified Phong reflects ks whatever its exponent.
class Phong : public HardCaseTest, public testing::WithParamInterface<double> {};
TEST_P(Phong, AlbedoHeadOnIsTheReflectance) {
    Material phong;
    phong.kind = MaterialKind::Phong;
    phong.baseColor = Vec3f(0.0f);
    phong.specular = Vec3f(0.75f);
    phong.phongExponent = float(GetParam());
    MeanCase c = planeUnderSky("Phong of exponent " + text("%g", GetParam()), 1, phong);
    c.bias = 1e-4;  // of the view's half-angle of .005
    expectMean(c, 0.75);
}
INSTANTIATE_TEST_SUITE_P(Exponent, Phong, testing::Values(1e3, 1e6),
                         [](const auto& n) { return codeName(text("%g", n.param)); });

}  // namespace
}  // namespace antipode::test
