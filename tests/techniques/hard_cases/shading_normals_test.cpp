// Normals that are not the surface's: light paths must be weighted by Veach's adjoint correction, and light that
// arrives from behind the surface must not leak through to the front of the interpolated normal.
#include <numbers>

#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Shading normals";

class HardShadingNormals : public HardCaseTest {
protected:
    /// A ball of 80 triangles, 18° wide each, seen from the side under a sun from above.
    static Scene ball(bool smooth) {
        Scene scene;
        addGeodesicSphere(scene, {0, 0, 0}, 1, 1, smooth, false, addLambert(scene, Vec3f(0.5f)));
        scene.directionalLights.push_back({{0, 0, -1}, Vec3f(1.0f)});
        scene.camera = lookAt({0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 0.6);
        return scene;
    }
};

/// A floor whose normals lean by .42 rad, under a sun from above: E·cos of that angle arrives, as everyone must agree.
/// Without the adjoint correction light paths would see the floor itself, on which 1/cos as much arrives.
TEST_F(HardShadingNormals, LeaningNormalsGiveTheClosedForm) {
    const Vec3f normal = normalize(Vec3f{0.4f, 0.2f, 1});
    MeanCase c{.group = kGroup, .difficulty = "a floor whose normals lean by .42 rad, under a sun"};
    addHorizontalSquare(c.scene, {0, 0, 0}, 1, addLambert(c.scene, Vec3f(0.5f)));
    c.scene.meshes.back().normals.assign(4, normal);
    c.scene.directionalLights.push_back({{0, 0, -1}, Vec3f(1.0f)});
    c.scene.camera = lookDownOn(0, 0, 1, 0.5);
    c.settings = smallImage(16, 0.02);
    c.settings.lightPathCount = 16384;
    c.techniques = {"pt", "lt", "bpt", "vcm", "ppm"};
    c.greatestError = 0.01;
    c.bias = 1e-6;  // rounding: pt has no variance
    expectMean(c, 0.5 / std::numbers::pi * double(normal.z));
}

/// The ball beside a floor, under a lamp: light that the one technique weighs by the normal on the light's side, the
/// other by the one on the camera's, over several bounces.
TEST_F(HardShadingNormals, EveryTechniqueEqualsPathTracingOnACoarseSmoothBall) {
    MeanCase c{.group = kGroup,
               .difficulty = "a smooth ball of 80 triangles on a floor whose normals lean, under a lamp"};
    c.scene = ball(true);
    c.scene.directionalLights.clear();
    addHorizontalSquare(c.scene, {0, 0, -1}, 3, addLambert(c.scene, Vec3f(0.7f)));
    c.scene.meshes.back().normals.assign(4, normalize(Vec3f{0.4f, 0.2f, 1}));
    addHorizontalSquare(c.scene, {0.5f, -0.5f, 3}, 0.7f, addLamp(c.scene, Vec3f(5.0f)), false);
    c.settings = smallImage(24, 0.01);
    c.settings.lightPathCount = 8192;
    c.settings.maxPathLength = 5;
    c.techniques = {"pt", "lt", "bpt", "vcm"};
    c.blocks = {{0, 12, 24, 24}};  // the lit half
    c.iterations = 48;
    expectAgreement(c);
}

/// The flat ball, with the same random numbers, tells where the surface itself faces the sun. Light paths of one bounce
/// start and splat at the same places, so that the comparison holds for them, too.
TEST_F(HardShadingNormals, NoLightLeaksThroughTheSurface) {
    RenderSettings settings = smallImage(48, 0.01);
    settings.maxPathLength = 2;
    settings.curvedTriangles = false;
    uint64_t leaks = 0, lit = 0;
    for (const char* technique : {"pt", "lt", "vcm"}) {
        settings.technique = technique;
        const std::vector<Image> smooth = samplesOf(ball(true), settings, 8),
                                 flat = samplesOf(ball(false), settings, 8);
        for (size_t i = 0; i < smooth.size(); ++i)
            for (size_t p = 0; p < smooth[i].pixels.size(); ++p) {
                lit += smooth[i].pixels[p].y > 0;
                leaks += smooth[i].pixels[p].y > 0 && flat[i].pixels[p].y == 0;
            }
    }
    EXPECT_GT(lit, 1000u);
    expectMeasured({kGroup, "a smooth ball of 80 triangles under a sun", "pixels lit where the surface faces away", 0},
                   double(leaks));
}

/// The shadow terminator: a ball of 320 smooth triangles under a sun from the side, beside the exact sphere with the
/// same random numbers. Facets that face away from the sun, to which their normals point, are black; curved there are
/// hardly any. The flat triangles show that the test sees them.
TEST_F(HardShadingNormals, NoFacetsShowAtTheTerminator) {
    RenderSettings settings = smallImage(128, 0.01);
    settings.technique = "pt";
    const auto render = [&](bool exact, bool curved) {
        Scene scene;
        const uint32_t white = addLambert(scene, Vec3f(0.8f));
        if (exact)
            scene.spheres.push_back({{0, 0, 0}, 1, white});
        else
            addGeodesicSphere(scene, {0, 0, 0}, 1, 2, true, false, white);
        scene.directionalLights.push_back({normalize(Vec3f{-1, -0.3f, -0.3f}), Vec3f(std::numbers::pi_v<float>)});
        scene.camera = lookAt({0, 0, 6}, {0, 0, 0}, {0, 1, 0}, 0.384);
        settings.curvedTriangles = curved;
        return renderSums(scene, settings, {1, 2, 3, 4, 5, 6, 7, 8}).image();
    };
    const Image sphere = render(true, true);
    const auto darker = [&](const Image& image) {
        uint64_t count = 0;
        for (size_t p = 0; p < image.pixels.size(); ++p) count += image.pixels[p].y < sphere.pixels[p].y - 0.1f;
        return count;
    };
    EXPECT_GT(darker(render(false, false)), 100u);
    expectMeasured({kGroup, "a smooth ball of 320 triangles under a sun from the side",
                    "pixels of 12,000 that are darker than the exact sphere by more than .1", 10},
                   double(darker(render(false, true))));
}

/// A ball of smooth glass under a uniform sky is invisible. Where facets contradict their normals, refraction leads
/// back into the glass and the path ends: flat triangles lose 1.7 % of the light, up to all of it in a pixel.
TEST_F(HardShadingNormals, SmoothGlassOfFewTrianglesIsInvisible) {
    Scene scene;
    addGeodesicSphere(scene, {0, 0, 0}, 1, 1, true, false, addGlass(scene));
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0, 0, 6}, {0, 0, 0}, {0, 1, 0}, 0.384);
    RenderSettings settings = smallImage(48, 0.01);
    settings.russianRoulette = false;
    settings.maxPathLength = 200;
    double lost = 0;
    for (const char* technique : {"pt", "vcm"}) {
        settings.technique = technique;
        const Image image = renderSums(scene, settings, {1, 2, 3, 4, 5, 6, 7, 8}).image();
        lost = std::max(lost, 1 - meanOf(image, {0, 0, 48, 48}, 1));
    }
    expectMeasured({kGroup, "a ball of 80 smooth glass triangles in a furnace", "light lost", 0.001}, lost);
}

}  // namespace
}  // namespace antipode::test
