// Paths of hundreds of edges: what a rounding does to each of them adds up, and nothing may end them early.
#include <algorithm>
#include <cmath>

#include "support/closed_forms.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Long paths";

class LongPaths : public HardCaseTest {
protected:
    /// Largest relative difference of any pixel from `expected`, over all techniques, of scenes without variance.
    double greatestDifference(const Scene& scene, RenderSettings settings, double expected) {
        double greatest = 0;
        for (const TechniqueInfo& technique : techniqueTable()) {
            settings.technique = technique.name;
            for (const Image& image : samplesOf(scene, settings, 1))
                for (const Vec3f& pixel : image.pixels)
                    greatest = std::max(greatest, std::abs(double(pixel.y) / expected - 1));
        }
        return greatest;
    }
};

/// A sphere that emits 1 and reflects everything: Le·(n+1) after n bounces.
TEST_F(LongPaths, ClosedFurnaceOfAlbedoOne) {
    constexpr uint32_t bounces = 255;
    MeanCase c{.group = kGroup, .difficulty = "closed furnace of albedo 1, 255 bounces"};
    const uint32_t wall = addLambert(c.scene, Vec3f(1.0f));
    c.scene.materials[wall].emission = Vec3f(1.0f);
    c.scene.materials[wall].emitsBothSides = true;
    c.scene.spheres.push_back({{0, 0, 0}, 1, wall});
    c.scene.camera = lookAt({0.1f, 0.2f, 0.3f}, {0.5f, -0.3f, 2}, {0, 1, 0}, 1.0);
    c.settings = smallImage(8, 0.1);
    c.settings.lightPathCount = 512;
    c.settings.russianRoulette = false;
    c.settings.maxPathLength = bounces + 1;
    c.techniques = {"pt", "pt-naive", "bpt", "vcm", "bpm"};
    c.iterations = 8;
    expectMean(c, bounces + 1);
}

/// The rays spread to ±1 of the mirrors' ±10. A throughput of 1000 factors errs by at most 1000 roundings.
TEST_F(LongPaths, FacingMirrorsAThousandBounces) {
    constexpr uint32_t bounces = 1000;
    Scene scene;
    const uint32_t mirror = addMirror(scene, 0.99f, 1);
    addHorizontalSquare(scene, {0, 0, 1}, 10, mirror, false);
    addHorizontalSquare(scene, {0, 0, -1}, 10, mirror);
    scene.camera = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1e-3);
    RenderSettings settings = smallImage(8, 0.1);
    settings.russianRoulette = false;
    settings.maxPathLength = bounces + 1;
    const double expected = closed_forms::facingMirrors(1, double(0.99f), bounces);
    expectMeasured({kGroup, "facing mirrors of reflectance .99, 1000 bounces", "largest relative error of a pixel",
                    bounces * 0x1p-24},
                   greatestDifference(scene, settings, expected));
}

/// A cube of index 2.4 under a uniform sky, the camera inside: a direction with no component beyond cos of the critical
/// angle, .909, never gets out, and is black; any other has n²L after some hundred inner reflections at most. Pixels
/// within .02 of the border between the two are left out.
TEST_F(LongPaths, GlassCubeThatTrapsLight) {
    constexpr float n = 2.4f;
    Scene scene;
    const uint32_t glass = addGlass(scene, n);
    const Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    for (const auto& [axis, u, v] : {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}}) {
        addQuad(scene, axis, u, v, glass);
        addQuad(scene, -axis, v, u, glass);
    }
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0.1f, -0.2f, 0.3f}, {1, 0.6f, 0.7f}, {0, 1, 0}, 1.2);
    RenderSettings settings = smallImage(48, 0.1);
    settings.russianRoulette = false;
    settings.maxPathLength = 1000;
    const double border = std::sqrt(1 - 1 / (double(n) * double(n)));
    const Vec3d forward(scene.camera.forward), right = normalize(cross(forward, Vec3d(scene.camera.up)));
    const Vec3d up = cross(right, forward);
    double worst = 0;
    uint64_t trapped = 0, free = 0;
    for (const char* technique : {"pt", "bpt", "vcm", "bpm"}) {
        settings.technique = technique;
        for (const Image& image : samplesOf(scene, settings, 2))
            for (uint32_t row = 0; row < 48; ++row)
                for (uint32_t column = 0; column < 48; ++column) {
                    const double scale = std::tan(0.6) / 24;
                    const Vec3d d =
                        normalize(forward + right * ((column + 0.5 - 24) * scale) + up * ((23.5 - row) * scale));
                    const double greatest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
                    if (std::abs(greatest - border) < 0.03) continue;
                    const double expected = greatest < border ? 0 : double(n) * double(n);
                    (greatest < border ? trapped : free)++;
                    const double value = image.pixels[size_t(row) * 48 + column].y;
                    worst = std::max(worst, std::abs(value - expected) / (double(n) * double(n)));
                }
    }
    EXPECT_GT(trapped, 100u);
    EXPECT_GT(free, 100u);
    expectMeasured({kGroup, "camera in a cube of index 2.4 that traps light, 1000 edges",
                    "largest error of a pixel, relative to n²L", 1e-4},
                   worst);
}

/// The same cube with a point light in it, inside a grey sphere: only light paths reach the wall.
TEST_F(LongPaths, LightThatIsTrappedInGlass) {
    MeanCase c{.group = kGroup, .difficulty = "point light in a cube of index 2.4, 1000 edges"};
    const uint32_t glass = addGlass(c.scene, 2.4f);
    const Vec3f x{0.2f, 0, 0}, y{0, 0.2f, 0}, z{0, 0, 0.2f};
    for (const auto& [axis, u, v] : {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}}) {
        addQuad(c.scene, axis, u, v, glass);
        addQuad(c.scene, -axis, v, u, glass);
    }
    c.scene.spheres.push_back({{0, 0, 0}, 1, addLambert(c.scene, Vec3f(0.5f))});
    addPointLight(c.scene, {0.01f, 0.02f, 0.03f}, Vec3f(1.0f));
    c.scene.camera = lookAt({-0.3f, -0.4f, -0.5f}, {-1, -1, 0}, {0, 1, 0}, 1.5);
    c.settings = smallImage(12, 0.1);
    c.settings.lightPathCount = 8192;
    c.settings.maxPathLength = 1000;
    c.techniques = {"lt", "bpt", "vcm", "bpm"};
    c.iterations = 16;
    c.mergeBias = 0.01;
    expectAgreement(c);
}

}  // namespace
}  // namespace antipode::test
