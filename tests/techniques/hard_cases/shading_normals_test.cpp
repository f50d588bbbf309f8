// Normals that are not the surface's: light paths must be weighted by Veach's adjoint correction, and light that
// arrives from behind the surface must not leak through to the front of the interpolated normal.
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

/// The ball over a floor that it lights, and that lights it, under a lamp: light that the one technique weighs by the
/// normal on the light's side, the other by the one on the camera's.
TEST_F(HardShadingNormals, EveryTechniqueEqualsPathTracingOnACoarseSmoothBall) {
    MeanCase c{.group = kGroup, .difficulty = "a smooth ball of 80 triangles beside a floor under a lamp"};
    c.scene = ball(true);
    c.scene.directionalLights.clear();
    addHorizontalSquare(c.scene, {0, 0, -1}, 3, addLambert(c.scene, Vec3f(0.7f)));
    addHorizontalSquare(c.scene, {0.5f, -0.5f, 3}, 0.7f, addLamp(c.scene, Vec3f(5.0f)), false);
    c.settings = smallImage(24, 0.01);
    c.settings.lightPathCount = 8192;
    c.settings.maxPathLength = 5;
    c.techniques = {"pt", "lt", "bpt", "vcm"};
    c.blocks = blocksOf(24, 24, 2, 2);
    c.iterations = 48;
    expectAgreement(c);
}

/// The flat ball, with the same random numbers, tells where the surface itself faces the sun. Light paths of one bounce
/// start and splat at the same places, so that the comparison holds for them, too.
TEST_F(HardShadingNormals, NoLightLeaksThroughTheSurface) {
    RenderSettings settings = smallImage(48, 0.01);
    settings.maxPathLength = 2;
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

}  // namespace
}  // namespace antipode::test
