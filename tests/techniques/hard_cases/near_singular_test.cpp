// Surfaces so close to each other, or seen at such angles, that cosines and squared distances nearly vanish.
#include <cmath>

#include "support/closed_forms.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Near-singular geometry";

std::string shortNumber(double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0e", v);
    return text;
}
std::string testName(double v) { return "TenToMinus" + std::to_string(int(std::lround(-std::log10(v)))); }

/// Nothing but extent: a black square far below, so that the scene's size is of the order of 1.
void addExtent(Scene& scene) { addHorizontalSquare(scene, {0, 0, -1}, 0.5f, addLambert(scene, Vec3f(0.0f))); }

/// A lamp that reflects half.
uint32_t addGreyLamp(Scene& scene) {
    const uint32_t lamp = addLambert(scene, Vec3f(0.5f));
    scene.materials[lamp].emission = Vec3f(1.0f);
    scene.materials[lamp].twoSided = false;
    return lamp;
}

class NearSingular : public HardCaseTest, public testing::WithParamInterface<double> {};

/// A distance, and the arithmetic that has to tell it from 0.
struct Gap {
    double width;
    Precision precision = Precision::Float;

    std::string name() const { return testName(width) + (precision == Precision::Double ? "InDouble" : ""); }
};
class NearSingularGap : public HardCaseTest, public testing::WithParamInterface<Gap> {};
const auto kNameOfGap = [](const auto& gap) { return gap.param.name(); };
const auto kGaps = testing::Values(Gap{1e-1}, Gap{1e-2}, Gap{1e-3}, Gap{1e-4}, Gap{1e-6}, Gap{1e-2, Precision::Double},
                                   Gap{1e-6, Precision::Double}, Gap{1e-12, Precision::Double});

/// Squares of half-width 4g at the distance g in a scene of size 1, both of which reflect: connections and merges of
/// lengths down to a small part of g, up to six edges. A camera between them sees the middle of the lower one, where a
/// disk of radius r = .2 g loses nothing. Merging's bias is r²/8·∇²L/L: the irradiance under an unbounded lamp is
/// constant, and what is missing beyond 3.5g, at most 1/13 of it, has a Laplacian of at most 1.1/g² times itself.
class FacingPatches : public NearSingular {};
TEST_P(FacingPatches, EveryTechniqueEqualsPathTracing) {
    const auto g = float(GetParam());
    MeanCase c{.group = kGroup, .difficulty = "patches that face each other " + shortNumber(GetParam()) + " apart"};
    addExtent(c.scene);
    addHorizontalSquare(c.scene, {0, 0, 0}, 4 * g, addLambert(c.scene, Vec3f(0.5f)));
    addHorizontalSquare(c.scene, {0, 0, g}, 4 * g, addGreyLamp(c.scene), false);
    c.scene.camera = lookDownOn(0, 0, 0.5 * double(g), 0.5 * double(g));
    c.settings = smallImage(16, 0.2 * double(g));
    c.settings.lightPathCount = 16384;
    c.settings.maxPathLength = 6;
    c.techniques = {"pt", "lt", "bpt", "vcm", "bpm"};
    c.mergeBias = 0.04 / 8 * 1.1 / 12;
    expectAgreement(c);
}
INSTANTIATE_TEST_SUITE_P(Apart, FacingPatches, testing::Values(1e-3, 1e-6, 1e-9, 1e-12),
                         [](const auto& gap) { return testName(gap.param); });

/// Plates of size 2 whose gap closes, in float to 1e-6: the distance along a slanting ray errs by roundings of the
/// plates.
class ClosingPlates : public NearSingularGap {};
TEST_P(ClosingPlates, EveryTechniqueEqualsTheClosedForm) {
    const double gap = GetParam().width;
    MeanCase c{.group = kGroup, .difficulty = "plates of size 2 that are " + shortNumber(gap) + " apart"};
    addHorizontalSquare(c.scene, {0, 0, 0}, 1, addLambert(c.scene, Vec3f(0.5f)));
    addHorizontalSquare(c.scene, {0, 0, float(gap)}, 1, addLamp(c.scene, Vec3f(1.0f)), false);
    c.scene.camera = lookDownOn(0, 0, 0.5 * gap, 0.5 * gap);
    c.settings = smallImage(16, 0.2);
    c.settings.lightPathCount = 16384;
    c.techniques = {"pt", "bpt", "vcm", "bpm"};
    c.settings.precision = GetParam().precision;
    expectMean(c, 0.5 * closed_forms::formFactorUnderCentre(2, 2, gap));
}
INSTANTIATE_TEST_SUITE_P(Apart, ClosingPlates, kGaps, kNameOfGap);

/// A corner of three walls of size 1 with a small ball lamp at the distance w from each of them; the camera sees the
/// corner's floor to 2 w. Light and camera vertices share the smallest places of the corner.
class CornerLamp : public NearSingular {};
TEST_P(CornerLamp, EveryTechniqueEqualsPathTracing) {
    const auto w = float(GetParam());
    MeanCase c{.group = kGroup, .difficulty = "a corner of unit walls, lit and seen from " + shortNumber(GetParam())};
    const uint32_t wall = addLambert(c.scene, Vec3f(0.6f));
    addQuad(c.scene, {0.5f, 0.5f, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}, wall);
    addQuad(c.scene, {0, 0.5f, 0.5f}, {0, 0.5f, 0}, {0, 0, 0.5f}, wall);
    addQuad(c.scene, {0.5f, 0, 0.5f}, {0, 0, 0.5f}, {0.5f, 0, 0}, wall);
    c.scene.spheres.push_back({{w, w, 1.5f * w}, 0.25f * w, addLamp(c.scene, Vec3f(4.0f))});
    c.scene.camera = lookAt({2 * w, 2 * w, 2 * w}, {0.6f * w, 0.6f * w, 0}, {0, 0, 1}, 0.5);
    c.settings = smallImage(16, 0.01 * double(w));
    c.settings.lightPathCount = 1024;
    c.settings.maxPathLength = 6;
    c.techniques = {"pt", "bpt", "vcm"};
    c.iterations = 32;
    expectAgreement(c);
}
INSTANTIATE_TEST_SUITE_P(Wide, CornerLamp, testing::Values(1e-1, 1e-3, 1e-4),
                         [](const auto& w) { return testName(w.param); });

/// A lamp that stands on the edge which it shares with a wall: the form factor at the distance x from the edge is
/// (atan(b/x) − x/s·atan(b/s))/π, s² = x² + h², for a lamp of height h and half-length b; ½ at the edge itself.
class TouchingLamp : public NearSingular {};
TEST_P(TouchingLamp, EveryTechniqueEqualsTheClosedForm) {
    const double w = GetParam();
    MeanCase c{.group = kGroup, .difficulty = "a lamp that touches a wall, seen to " + shortNumber(2 * w) + " from it"};
    addQuad(c.scene, {0.5f, 0, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}, addLambert(c.scene, Vec3f(0.5f)));
    addQuad(c.scene, {0, 0, 0.5f}, {0, 0.5f, 0}, {0, 0, 0.5f}, addLamp(c.scene, Vec3f(1.0f)));
    c.scene.camera = lookDownOn(w, 0, w, 0.98 * w);
    c.settings = smallImage(16, 0.01 * w);
    c.settings.lightPathCount = 1024;
    c.techniques = {"pt", "bpt", "vcm"};
    double expected = 0;
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
        const double x = w + 0.98 * w * (2 * (i + 0.5) / steps - 1), s = std::hypot(x, 1);
        expected += 0.5 * (std::atan(0.5 / x) - x / s * std::atan(0.5 / s)) / std::numbers::pi / steps;
    }
    expectMean(c, expected);
}
INSTANTIATE_TEST_SUITE_P(Within, TouchingLamp, testing::Values(1e-2, 1e-3, 1e-4),
                         [](const auto& w) { return testName(w.param); });

/// The floor beside the edge of a lamp of size 2 at the height h, as far as 2 h out: light that leaves and arrives at
/// grazing angles. Form factors of signed corners.
class HoveringLamp : public NearSingularGap {};
TEST_P(HoveringLamp, EveryTechniqueEqualsTheClosedForm) {
    const double h = GetParam().width;
    MeanCase c{.group = kGroup, .difficulty = "a lamp of size 2 hovers " + shortNumber(h) + " above a floor"};
    addHorizontalSquare(c.scene, {0, 0, 0}, 1, addLambert(c.scene, Vec3f(0.5f)));
    addHorizontalSquare(c.scene, {-1, 0, float(h)}, 1, addLamp(c.scene, Vec3f(1.0f)), false);
    c.scene.camera = lookDownOn(h, 0, h, 0.98 * h);
    c.settings = smallImage(24, 0.01 * h);
    c.settings.lightPathCount = 4096;
    c.techniques = {"pt", "bpt", "vcm"};
    c.iterations = 48;
    double expected = 0;
    constexpr int steps = 256;
    for (int i = 0; i < steps; ++i) {
        const double x = h + 0.98 * h * (2 * (i + 0.5) / steps - 1);
        expected += 0.5 * 2 *
                    (closed_forms::formFactorUnderCorner(2 + x, 1, h) - closed_forms::formFactorUnderCorner(x, 1, h)) /
                    steps;
    }
    c.settings.precision = GetParam().precision;
    expectMean(c, expected);
}
INSTANTIATE_TEST_SUITE_P(At, HoveringLamp, kGaps, kNameOfGap);

/// Sun and camera at the same elevation e over a floor: E = E₀ sin e, without variance but for light paths, to
/// float32's rounding. Of the sun's disk around the scene, .75 π, the camera sees .04 e² and merging reaches π·1e-8 e:
/// 4096 light paths against 256 camera paths give splats .27 e² of the weight and merges 5.5e-5 e. Where that is next
/// to nothing none need come.
class Grazing : public NearSingular {};
TEST_P(Grazing, SunAndCameraGiveTheClosedForm) {
    const double elevation = GetParam();
    MeanCase c{.group = kGroup, .difficulty = "sun and view " + shortNumber(elevation) + " rad above the floor"};
    addHorizontalSquare(c.scene, {0, 0, 0}, 0.5f, addLambert(c.scene, Vec3f(0.5f)));
    addHorizontalSquare(c.scene, {0, 0, -1}, 0.5f, addLambert(c.scene, Vec3f(0.0f)));
    const Vec3d sun(0, -std::cos(elevation), -std::sin(elevation));
    c.scene.directionalLights.push_back({Vec3f(sun), Vec3f(float(1 / elevation))});
    const Vec3f eye(Vec3d(std::cos(elevation), 0, std::sin(elevation)));
    c.scene.camera = lookAt(eye, {0, 0, 0}, {0, 0, 1}, 0.2 * elevation);
    c.settings = smallImage(16, 1e-4);
    c.settings.lightPathCount = 4096;
    const double expected = 0.5 / std::numbers::pi * std::sin(elevation) / elevation;
    c.techniques = {"pt"};
    c.bias = 1e-6;
    expectMean(c, expected);

    c.difficulty += ", with light paths";
    c.techniques = {"bpt", "vcm"};
    const double splats = 0.27 * elevation * elevation;
    if (splats < 1e-4) c.bias += splats;
    c.mergeBias = 5.5e-5 * elevation;
    expectMean(c, expected);
}
INSTANTIATE_TEST_SUITE_P(At, Grazing, testing::Values(1e-1, 1e-2, 1e-3, 1e-5),
                         [](const auto& e) { return testName(e.param); });

}  // namespace
}  // namespace antipode::test
