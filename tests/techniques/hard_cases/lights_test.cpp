// Lights of extreme size, number and radiance, and lights that are hard to reach.
#include <cmath>

#include "support/closed_forms.h"
#include "tests/techniques/agreement_scenes.h"
#include "tests/techniques/differing_sums.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Lights";
constexpr double kReflectance = 0.5, kMergeRadius = 0.02;

/// Bound on merging's relative bias r²/8·|∇²L|/L on a floor under lamps at this height. A lamp of no extent gives
/// (h² + s²)^-2 if it is flat and (h² + s²)^-3/2 if it is a sphere, at the distance s from its foot, whose Laplacians
/// are at most 8/h² and 6/h² of them.
constexpr double mergeBiasUnder(double height) { return kMergeRadius * kMergeRadius / (height * height); }

class HardLights : public HardCaseTest {
protected:
    /// A floor of half-width 1, of which the camera sees the middle to ±.5 from a height of .5.
    static MeanCase overFloor(const std::string& difficulty) {
        MeanCase c{.group = kGroup, .difficulty = difficulty};
        addHorizontalSquare(c.scene, {0, 0, 0}, 1, addLambert(c.scene, Vec3f(float(kReflectance))));
        c.scene.camera = lookDownOn(0, 0, 0.5, 0.5);
        c.settings = smallImage(16, kMergeRadius);
        c.settings.lightPathCount = 4096;
        return c;
    }

    /// Mean of a function of the floor over what overFloor's camera sees.
    template <typename F>
    static double meanOverFloor(F radiance) {
        constexpr int steps = 64;
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) sum += radiance((i + 0.5) / steps - 0.5, (j + 0.5) / steps - 0.5);
        return sum / (steps * steps);
    }
};

/// Like a point light of intensity L·A·cosθ.
TEST_F(HardLights, SquareOfAMillionth) {
    MeanCase c = overFloor("square lamp of half-width 1e-6");
    addHorizontalSquare(c.scene, {0, 0, 1}, 1e-6f, addLamp(c.scene, Vec3f(0.25e12f)), false);
    c.techniques = {"pt", "lt", "bpt", "vcm", "bpm"};
    c.mergeBias = mergeBiasUnder(1);
    expectMean(c, meanOverFloor([](double x, double y) {
                   return kReflectance / std::numbers::pi / std::pow(1 + x * x + y * y, 2);
               }));
}

TEST_F(HardLights, SphereOfAMillionth) {
    MeanCase c = overFloor("sphere lamp of radius 1e-6");
    const double radiance = 1e12;
    c.scene.spheres.push_back({{0, 0, 1}, 1e-6f, addLamp(c.scene, Vec3f(float(radiance)))});
    c.techniques = {"pt", "lt", "bpt", "vcm", "bpm"};
    c.mergeBias = mergeBiasUnder(1);
    expectMean(c, meanOverFloor([&](double x, double y) {
                   return kReflectance / std::numbers::pi *
                          closed_forms::irradianceOfSphereLight(radiance, 1e-6, 1, std::hypot(x, y));
               }));
}

/// Of lamps that fill the sky: every sample of naive path tracing is the reflectance but for float's rounding, which is
/// then all that its t-test would see.
constexpr double kRounding = 0x1p-22;

/// Light paths all but miss the floor, which must cost noise and nothing else.
TEST_F(HardLights, SquareOfAMillion) {
    MeanCase c = overFloor("square lamp of half-width 1e6");
    addHorizontalSquare(c.scene, {0, 0, 1}, 1e6f, addLamp(c.scene, Vec3f(1.0f)), false);
    c.techniques = {"pt", "pt-naive", "bpt", "vcm"};
    c.bias = kRounding;
    expectMean(c, kReflectance);
}

TEST_F(HardLights, SphereOfAMillionAroundTheScene) {
    MeanCase c = overFloor("sphere lamp of radius 1e6 around the scene");
    const uint32_t lamp = addLamp(c.scene, Vec3f(1.0f), true);
    c.scene.spheres.push_back({{0, 0, 0}, 1e6f, lamp});
    c.techniques = {"pt", "pt-naive", "bpt", "vcm"};
    c.bias = kRounding;
    expectMean(c, kReflectance);
}

/// 100 × 100 small squares whose radiances span five orders of magnitude; the floor's irradiance is their sum.
TEST_F(HardLights, TenThousandLamps) {
    MeanCase c = overFloor("10^4 lamps whose powers span 1e5");
    constexpr int count = 100;
    constexpr float half = 0.004f, height = 0.6f;
    std::array<uint32_t, 6> materials{};
    for (int i = 0; i < 6; ++i) materials[size_t(i)] = addLamp(c.scene, Vec3f(float(std::pow(10.0, i - 2))));
    struct Lamp {
        double x, y, power;
    };
    std::vector<Lamp> lamps;
    for (int i = 0; i < count * count; ++i) {
        const float x = (float(i % count) + 0.5f) * 0.02f - 1, y = (float(i / count) + 0.5f) * 0.02f - 1;
        const auto kind = size_t(i * 7919 % 6);
        addHorizontalSquare(c.scene, {x, y, height}, half, materials[kind], false);
        lamps.push_back({x, y, 4 * half * half * double(c.scene.materials[materials[kind]].emission.x)});
    }
    // A square seen from 75 times its width away is a point to 75^-2.
    constexpr int steps = 24;
    double expected = 0;
    for (int i = 0; i < steps * steps; ++i)
        for (const Lamp& lamp : lamps) {
            const double dx = (i % steps + 0.5) / steps - 0.5 - lamp.x, dy = (i / steps + 0.5) / steps - 0.5 - lamp.y;
            const double d2 = dx * dx + dy * dy + double(height) * double(height);
            expected += kReflectance / std::numbers::pi * lamp.power * double(height) * double(height) / (d2 * d2) /
                        (steps * steps);
        }
    c.techniques = {"pt", "lt", "bpt", "vcm", "bpm"};
    c.bias = 2e-4;
    c.mergeBias = mergeBiasUnder(double(height));
    expectMean(c, expected);
}

/// A spot light that draws the same spot from afar: its cosines differ from 1 by less than a float can say.
class NarrowSpot : public HardCaseTest, public testing::WithParamInterface<double> {};
TEST_P(NarrowSpot, EveryTechniqueEqualsTheClosedForm) {
    const double outer = GetParam(), inner = 0.5 * outer, height = 1 / outer;
    char difficulty[64];
    std::snprintf(difficulty, sizeof difficulty, "spot light of half-angle %.0e rad", outer);
    MeanCase c{.group = kGroup, .difficulty = difficulty};
    addHorizontalSquare(c.scene, {0, 0, 0}, 2, addLambert(c.scene, Vec3f(float(kReflectance))));
    c.scene.spotLights.push_back(
        {{0, 0, float(height)}, {0, 0, -1}, Vec3f(float(height * height)), float(inner), float(outer)});
    c.scene.camera = lookDownOn(0, 0, 2, 1.1);
    c.settings = smallImage(16, kMergeRadius);
    c.settings.lightPathCount = 1024;
    c.techniques = {"pt", "lt", "bpt", "vcm"};
    double expected = 0;
    constexpr int steps = 400;
    for (int i = 0; i < steps * steps; ++i) {
        const double x = 1.1 * (2 * (i % steps + 0.5) / steps - 1), y = 1.1 * (2 * (i / steps + 0.5) / steps - 1);
        // Versines 2 sin²(θ/2), which do not cancel.
        const auto versine = [](double angle) { return 2 * std::pow(std::sin(0.5 * angle), 2); };
        const double angle = std::atan(std::hypot(x, y) / height), cosine = std::cos(angle);
        const double t = std::clamp((versine(outer) - versine(angle)) / (versine(outer) - versine(inner)), 0.0, 1.0);
        expected += kReflectance / std::numbers::pi * cosine * cosine * cosine * t * t / (steps * steps);
    }
    c.bias = 2e-4;  // of the sum above at the spot's border
    expectMean(c, expected);
}
INSTANTIATE_TEST_SUITE_P(HalfAngle, NarrowSpot, testing::Values(1e-1, 1e-2, 1e-3, 1e-4), [](const auto& angle) {
    return "TenToMinus" + std::to_string(int(std::lround(-std::log10(angle.param))));
});

/// All that emits × 2^k gives the same sums, in units that are 2^k as large: nothing in the kernels has an absolute
/// radiance. Float32's 2^±20 are about 1e±6.
TEST_F(HardLights, RadianceScalesExactly) {
    const auto brightened = [](Scene scene, float factor) {
        for (Material& m : scene.materials) m.emission *= factor;
        for (PointLight& l : scene.pointLights) l.intensity *= factor;
        for (SpotLight& l : scene.spotLights) l.intensity *= factor;
        for (DirectionalLight& l : scene.directionalLights) l.irradiance *= factor;
        if (scene.environment) scene.environment->radiance *= factor;
        return scene;
    };
    RenderSettings settings = smallImage(24, kMergeRadius);
    double differing = 0;
    for (const Scene& scene : {lampsScene(), skyScene(), specularScene()})
        for (const char* technique : {"pt", "vcm"}) {
            settings.technique = technique;
            const FilmSums sums = renderSums(scene, settings, {1, 2});
            for (const int exponent : {-20, 20}) {
                FilmSums other = renderSums(brightened(scene, std::ldexp(1.0f, exponent)), settings, {1, 2});
                EXPECT_EQ(other.layout.layers[0].scaleExponent, sums.layout.layers[0].scaleExponent - exponent);
                other.layout = sums.layout;
                differing += differingSums(other, sums);
            }
        }
    expectMeasured({kGroup, "radiances scaled by 2^-20 and 2^20", "differing sums", 0}, differing);
}

/// The lamp is a small ball inside a ball of glass: neither next-event samples nor light paths without refraction reach
/// the floor. By symmetry the glass makes it a ball of radius .15; merging's bias is that of a lamp at its height.
TEST_F(HardLights, SeenOnlyThroughGlass) {
    MeanCase c = overFloor("lamp seen only through glass");
    c.scene.spheres.push_back({{0, 0, 0.8f}, 0.1f, addLamp(c.scene, Vec3f(20.0f))});
    c.scene.spheres.push_back({{0, 0, 0.8f}, 0.3f, addGlass(c.scene)});
    c.scene.camera = lookDownOn(0, 0, 0.4, 0.4);
    c.settings.width = c.settings.height = 48;  // only by chance does path tracing hit the lamp
    c.techniques = {"bpt", "vcm", "lt", "bpm", "pt", "pt-naive"};
    c.iterations = 48;
    c.mergeBias = mergeBiasUnder(0.8);
    expectAgreement(c);
}

/// A lamp behind a black wall with a hole of .1 × .1, which is all that the floor sees of it: the hole's form factor.
/// Merging sees the hole as a small lamp.
TEST_F(HardLights, BehindAKeyhole) {
    MeanCase c{.group = kGroup, .difficulty = "lamp behind a hole of .1 in a wall"};
    constexpr float hole = 0.05f, outer = 0.65f, height = 0.5f;
    addHorizontalSquare(c.scene, {0, 0, 0}, 0.5f, addLambert(c.scene, Vec3f(float(kReflectance))));
    const uint32_t black = addLambert(c.scene, Vec3f(0.0f));
    for (const float side : {-1.0f, 1.0f}) {
        const float middle = 0.5f * (outer + hole), half = 0.5f * (outer - hole);
        addQuad(c.scene, {side * middle, 0, height}, {half, 0, 0}, {0, outer, 0}, black);
        addQuad(c.scene, {0, side * middle, height}, {hole, 0, 0}, {0, half, 0}, black);
    }
    addHorizontalSquare(c.scene, {0, 0, height + 0.2f}, 0.3f, addLamp(c.scene, Vec3f(1.0f)), false);
    c.scene.camera = lookDownOn(0, 0, 0.4, 0.2);
    c.settings = smallImage(32, kMergeRadius);
    c.settings.lightPathCount = 16384;
    c.techniques = {"pt", "lt", "bpt", "vcm", "bpm"};
    c.greatestError = 0.04;
    c.mergeBias = mergeBiasUnder(double(height));
    double expected = 0;
    constexpr int steps = 64;
    const auto corner = closed_forms::formFactorUnderCorner;
    for (int i = 0; i < steps * steps; ++i) {
        const double x = 0.2 * (2 * (i % steps + 0.5) / steps - 1), y = 0.2 * (2 * (i / steps + 0.5) / steps - 1);
        const double a = double(hole) - x, b = -double(hole) - x, e = double(hole) - y, f = -double(hole) - y;
        expected += kReflectance *
                    (corner(a, e, height) - corner(b, e, height) - corner(a, f, height) + corner(b, f, height)) /
                    (steps * steps);
    }
    expectMean(c, expected);
}

}  // namespace
}  // namespace antipode::test
