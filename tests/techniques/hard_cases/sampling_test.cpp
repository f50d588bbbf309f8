// Materials at the ends of their parameters, in furnaces.
#include <algorithm>
#include <cmath>
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

class RoughGlass : public HardCaseTest {};
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

constexpr double kBallDistance = 4, kBallView = 0.45;

/// A ball of rough, colourless glass and radius 1 in a furnace of 1.
MeanCase roughBall(const std::string& difficulty, double ior, float roughness) {
    MeanCase c{.group = kGroup, .difficulty = difficulty};
    const uint32_t glass = addMaterial(c.scene, MaterialKind::RoughDielectric, Vec3f(1.0f), roughness);
    c.scene.materials[glass].ior = float(ior);
    c.scene.spheres.push_back({{0, 0, 0}, 1, glass});
    setConstantSky(c.scene, Vec3f(1.0f));
    c.scene.camera = lookAt({0, 0, float(kBallDistance)}, {0, 0, 0}, {0, 1, 0}, kBallView);
    c.settings = smallImage(16, 0.1);
    c.settings.russianRoulette = false;
    c.settings.maxPathLength = 30;
    return c;
}

/// p of the null hypothesis that the expectation is at most `bound`.
double pOfAtMost(const Moments& moments, double bound) {
    const double two = tTest(moments, bound).pValue;
    return moments.mean() > bound ? two / 2 : 1 - two / 2;
}

/// Rough glass loses what would scatter twice between its facets and never gains. Null hypothesis: no mean is above 1;
/// one-sided t-tests, α = .01 over all of them (Šidák). Every technique agrees with path tracing besides.
TEST_P(Ior, RoughGlassCreatesNoLight) {
    const std::vector<float> roughnesses{0.05f, 0.3f, 1.0f};
    const std::vector<const char*> techniques{"pt", "pt-naive", "vcm"};
    double surprise = 0;
    for (const float roughness : roughnesses) {
        MeanCase c = roughBall("", GetParam(), roughness);
        std::optional<Moments> first;
        for (const char* technique : techniques) {
            SCOPED_TRACE(testing::Message() << technique << ", roughness " << roughness);
            c.settings.technique = technique;
            c.settings.seed++;
            const Moments moments = momentsOf(samplesOf(c.scene, c.settings, 16), {0, 0, 16, 16}, 1);
            EXPECT_LE(std::sqrt(moments.meanVariance()), 0.05 * moments.mean());
            if (first)
                EXPECT_GE(welchTest(moments, *first).pValue,
                          sidak(kAlpha, (techniques.size() - 1) * roughnesses.size()));
            else
                first = moments;
            surprise = std::max(surprise, -std::log10(pOfAtMost(moments, 1)));
        }
    }
    expectMeasured({kGroup, "rough glass of ior " + text("%g", GetParam()) + " in a furnace",
                    "largest −log₁₀ p of one-sided t-tests against more than 1",
                    -std::log10(sidak(kAlpha, roughnesses.size() * techniques.size()))},
                   surprise);
}

std::string nameOfIor(const testing::TestParamInfo<double>& ior) {
    return ior.param == 1 ? "One" : ior.param < 1.01 ? "JustAboveOne" : "OneAndAHalf";
}
INSTANTIATE_TEST_SUITE_P(Of, Ior, testing::Values(1.0, 1.0001, 1.5), nameOfIor);

/// Glass of index 1 is invisible, whatever its facets.
TEST_F(RoughGlass, OfIndexOneIsInvisible) {
    for (const float roughness : {0.05f, 0.3f, 1.0f}) {
        MeanCase c = roughBall("rough glass of ior 1, invisible", 1, roughness);
        c.techniques = {"pt", "pt-naive", "vcm"};
        expectMean(c, 1);
    }
}

/// Of roughBall's image, where facets neither reflect nor turn the light: each of the two surfaces that a ray crosses,
/// at the same angle, lets pass the share G₂/G₁ of the facets seen by it (Smith's, height-correlated).
double straightThroughRoughBall(double alpha) {
    constexpr int n = 1000;
    const double edge = std::tan(0.5 * kBallView);
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double x = (i + 0.5) / n * edge, y = (j + 0.5) / n * edge, tangent2 = x * x + y * y;
            const double sine2 = kBallDistance * kBallDistance * tangent2 / (1 + tangent2);
            const double lambda = sine2 < 1 ? 0.5 * (std::sqrt(1 + alpha * alpha * sine2 / (1 - sine2)) - 1) : 0;
            const double share = (1 + lambda) / (1 + 2 * lambda);
            sum += share * share;
        }
    return sum / (n * n);
}

/// Nearly equal indices reflect 2.5e-9, and turn the light by 1e-4 but for grazing facets: the loss is the shadowing's.
TEST_F(RoughGlass, OfIndexJustAboveOneLosesItsShadowing) {
    for (const float roughness : {0.05f, 0.3f, 1.0f}) {
        MeanCase c = roughBall("rough glass of ior 1.0001, whose facets only shadow", 1.0001, roughness);
        c.techniques = {"pt", "pt-naive", "vcm"};
        c.bias = 1e-4;  // of the turn
        expectMean(c, straightThroughRoughBall(double(roughness) * double(roughness)));
    }
}

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
    const char* name;
    double alpha, cosine;
};

/// A perfect GGX reflector (index 0 + i) shows its single-scattering albedo; α just above what counts as smooth, too.
class Ggx : public HardCaseTest, public testing::WithParamInterface<GgxCase> {};
TEST_P(Ggx, AlbedoIsTheClosedForm) {
    const auto [name, alpha, cosine] = GetParam();
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
INSTANTIATE_TEST_SUITE_P(Of, Ggx,
                         testing::Values(GgxCase{"HeadOnAlmostSmooth", 1.1e-4, 1},
                                         GgxCase{"SlantingAlmostSmooth", 1.1e-4, 0.1},
                                         GgxCase{"GrazingAlphaOneTenth", 0.1, 0.01},
                                         GgxCase{"GrazingAlphaOne", 1, 0.01}),
                         [](const auto& g) { return g.param.name; });

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
                         [](const auto& n) { return n.param == 1e3 ? "AThousand" : "AMillion"; });

}  // namespace
}  // namespace antipode::test
