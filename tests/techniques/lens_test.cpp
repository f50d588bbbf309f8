// The thin lens against its geometry: a small lamp out of focus is seen as a disk.
#include <cmath>

#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

/// A lamp at twice the focus distance F behind a lens of radius R: the rays to it fill a disk of radius R·(z−F)/z = R/2
/// on the plane in focus. With F = 1, R = .5 and an image plane 32 pixels away that is a disk of 8 pixels, evenly lit;
/// the lamp's own radius widens it by .05/2·32 = .8 pixels.
class EngineLens : public EngineTest {
protected:
    static Scene lampOutOfFocus() {
        Scene scene;
        Material& lamp = scene.materials.emplace_back();
        lamp.baseColor = Vec3f(0.0f);
        lamp.emission = Vec3f(1.0f);
        scene.spheres.push_back({{0, 0, -2}, 0.05f, 0});
        scene.camera.verticalFov = float(std::acos(0.0));
        scene.camera.lensRadius = 0.5f;
        scene.camera.focusDistance = 1.0f;
        return scene;
    }
};

// H₀: a quarter of the light lies within half the disk's radius. About 2000 of the 4.2 M camera rays meet the lamp
// (seed 1), so that the share has a standard error of .01; it may differ by .04. A pinhole has all of it within 1
// pixel.
TEST_F(EngineLens, LampOutOfFocusFillsTheCircleOfConfusion) {
    RenderSettings settings;
    settings.width = settings.height = 64;
    settings.technique = "pt-naive";
    settings.maxPathLength = 1;
    std::vector<uint64_t> iterations(1024);
    for (size_t i = 0; i < iterations.size(); ++i) iterations[i] = i + 1;
    const Image image = renderSums(lampOutOfFocus(), settings, iterations).image();
    double total = 0, within = 0;
    uint32_t outside = 0;
    for (uint32_t y = 0; y < 64; ++y)
        for (uint32_t x = 0; x < 64; ++x) {
            const double radius = std::hypot(x + 0.5 - 32, y + 0.5 - 32), value = image.pixels[y * 64 + x].x;
            total += value;
            if (radius < 4) within += value;
            outside += radius > 8 + 0.8 + 0.75 && value != 0;
        }
    ASSERT_GT(total, 0);
    const std::string difficulty = "a small lamp out of focus becomes an evenly lit disk";
    expectWithin({"Sampling", difficulty, "error of the share within half the disk's radius", 0.04},
                 std::abs(within / total - 0.25), deviceName());
    expectWithin({"Sampling", difficulty, "lit pixels outside", 0}, outside, deviceName());
}

}  // namespace
}  // namespace antipode::test
