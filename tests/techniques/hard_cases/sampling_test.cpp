// Materials at the ends of their parameters, in furnaces.
#include <algorithm>
#include <cmath>

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

/// A ball of rough, colourless glass and radius 1 in a furnace of 1.
MeanCase roughBall(const std::string& difficulty, double ior, float roughness) {
    MeanCase c{.group = kGroup, .difficulty = difficulty};
    const uint32_t glass = addMaterial(c.scene, MaterialKind::RoughDielectric, Vec3f(1.0f), roughness);
    c.scene.materials[glass].ior = float(ior);
    c.scene.spheres.push_back({{0, 0, 0}, 1, glass});
    setConstantSky(c.scene, Vec3f(1.0f));
    c.scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.45);
    c.settings = smallImage(16, 0.1);
    c.settings.russianRoulette = false;
    c.settings.maxPathLength = 30;
    return c;
}

/// A ball of rough glass in uniform light cannot be seen, whatever its facets; of index 1 it is no glass at all.
TEST_P(Ior, RoughGlassLosesNoLight) {
    for (const float roughness : {0.05f, 0.3f, 1.0f}) {
        MeanCase c = roughBall("rough glass of ior " + text("%g", GetParam()) + " in a furnace", GetParam(), roughness);
        c.techniques = {"pt", "pt-naive", "vcm"};
        c.bias = GetParam() == 1 ? 0 : 0.005;  // of the tables
        expectMean(c, 1);
    }
}

std::string nameOfIor(const testing::TestParamInfo<double>& ior) {
    return ior.param == 1 ? "One" : ior.param < 1.01 ? "JustAboveOne" : "OneAndAHalf";
}
INSTANTIATE_TEST_SUITE_P(Of, Ior, testing::Values(1.0, 1.0001, 1.5), nameOfIor);

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

/// A perfect GGX reflector (index 0 + i) reflects all, at grazing angles, and with α just above what counts as smooth.
class Ggx : public HardCaseTest, public testing::WithParamInterface<GgxCase> {};
TEST_P(Ggx, ReflectsAll) {
    const auto [name, alpha, cosine] = GetParam();
    Material metal;
    metal.kind = MaterialKind::RoughConductor;
    metal.roughness = float(std::sqrt(alpha));
    metal.conductorEta = Vec3f(0.0f);
    metal.conductorK = Vec3f(1.0f);
    MeanCase c =
        planeUnderSky("GGX of α " + text("%g", alpha) + " seen at a cosine of " + text("%g", cosine), cosine, metal);
    c.settings.width = c.settings.height = 32;
    c.bias = 1e-3;  // of the tables
    expectMean(c, 1);
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
