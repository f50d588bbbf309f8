// Merging where its disk is larger than the scene, smaller than a pixel could matter, or reaches through walls.
//
// The estimate at a point is the light that arrives within the radius r, over πr². Where surfaces end within r it is
// too low, and where light is on one side of a wall and the point on the other, both on the same floor, it is too high:
// the boundary bias of density estimation, which vanishes with r. Light on the far side of a surface never counts,
// however thin the surface is.
#include <cmath>

#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Merging";
constexpr double kReflectance = 0.5;

class HardMerging : public HardCaseTest {
protected:
    /// A floor of half-width w under a sun of irradiance 1 on it, seen from above to ±w/2.
    static MeanCase underSun(const std::string& difficulty, float w) {
        MeanCase c{.group = kGroup, .difficulty = difficulty};
        addHorizontalSquare(c.scene, {0, 0, 0}, w, addLambert(c.scene, Vec3f(float(kReflectance))));
        c.scene.directionalLights.push_back({{0, 0, -1}, Vec3f(1.0f)});
        c.scene.camera = lookDownOn(0, 0, double(w), 0.5 * double(w));
        return c;
    }

    /// Pixels of which a channel is not 0, over the first iterations.
    uint64_t litPixels(const Scene& scene, const RenderSettings& settings, uint64_t iterations) {
        uint64_t lit = 0;
        for (const Image& image : samplesOf(scene, settings, iterations))
            for (const Vec3f& pixel : image.pixels) lit += pixel.x != 0 || pixel.y != 0 || pixel.z != 0;
        return lit;
    }
};

/// All that arrives, 4w², over πr².
TEST_F(HardMerging, RadiusBeyondTheScene) {
    MeanCase c = underSun("merge radius ten times the scene", 1);
    c.settings = smallImage(16, 10);
    c.settings.lightPathCount = 1024;
    c.techniques = {"ppm"};
    expectMean(c, kReflectance / std::numbers::pi * 4 / (std::numbers::pi * 100));
}

/// The same with 16384 photons on a floor of a thousandth of the scene's size, all of them in one cell.
TEST_F(HardMerging, AllPhotonsInOneCell) {
    MeanCase c{.group = kGroup, .difficulty = "16384 photons in one cell"};
    constexpr float w = 0.001f;
    addHorizontalSquare(c.scene, {0, 0, 0}, w, addLambert(c.scene, Vec3f(float(kReflectance))));
    addHorizontalSquare(c.scene, {0, 0, -1}, 0.5f, addLambert(c.scene, Vec3f(0.0f)));
    c.scene.spotLights.push_back({{0, 0, 0.02f}, {0, 0, -1}, Vec3f(1.0f), 0.04f, 0.045f});
    c.scene.camera = lookDownOn(0, 0, 0.002, 0.0005);
    c.settings = smallImage(16, 0.1);
    c.settings.lightPathCount = 16384;
    c.techniques = {"ppm"};
    c.iterations = 8;
    c.bias = std::sqrt(16384) * 0x1p-24;  // of a sum of so many terms
    // The spot's flux: its falloff is linear, squared, in the versine between the two angles.
    const double inner = 2 * std::pow(std::sin(0.02), 2), outer = 2 * std::pow(std::sin(0.0225), 2);
    const double flux = 2 * std::numbers::pi * (inner + (outer - inner) / 3);
    expectMean(c, kReflectance / std::numbers::pi * flux / (std::numbers::pi * 0.01));
}

/// Merges next to never happen, and are weighted as if they did not exist: the image is that of bidirectional path
/// tracing with the same random numbers.
TEST_F(HardMerging, RadiusOfATenMillionth) {
    MeanCase c = underSun("", 1);
    c.settings = smallImage(16, 1e-7);
    c.settings.lightPathCount = 4096;
    std::vector<Image> images;
    for (const char* technique : {"vcm", "bpt"}) {
        c.settings.technique = technique;
        images.push_back(samplesOf(c.scene, c.settings, 1).front());
    }
    double difference = 0, sum = 0;
    for (size_t i = 0; i < images[0].pixels.size(); ++i) {
        difference += std::abs(double(images[0].pixels[i].y) - double(images[1].pixels[i].y));
        sum += images[1].pixels[i].y;
    }
    EXPECT_GT(sum, 0);
    expectMeasured(
        {kGroup, "merge radius of 1e-7 of the scene, vcm against bpt", "mean relative difference of pixels", 1e-6},
        difference / sum);
}

/// A wall of thickness 0 or less than r, lit from one side: seen from the other it is black, to the last bit.
TEST_F(HardMerging, NothingLeaksThroughThinWalls) {
    uint64_t lit = 0;
    for (const float thickness : {0.0f, 1e-6f, 0.01f}) {
        Scene scene;
        const uint32_t wall = addLambert(scene, Vec3f(float(kReflectance)));
        addHorizontalSquare(scene, {0, 0, 0}, 1, wall);
        if (thickness > 0) addHorizontalSquare(scene, {0, 0, -thickness}, 1, wall, false);
        addPointLight(scene, {0, 0, 0.5f}, Vec3f(1.0f));
        RenderSettings settings = smallImage(16, 0.1);
        settings.lightPathCount = 4096;
        for (const char* technique : {"bpt", "vcm", "bpm", "ppm"}) {
            settings.technique = technique;
            scene.camera = lookAt({0, 0, -1}, {0, 0, 0}, {0, 1, 0}, 0.8);
            lit += litPixels(scene, settings, 4);
            scene.camera = lookAt({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 0.8);
            EXPECT_EQ(litPixels(scene, settings, 1), 16u * 16) << technique << ", from the lit side";
        }
    }
    expectMeasured({kGroup, "walls thinner than the merge radius, lit from behind", "pixels that are not black", 0},
                   double(lit));
}

/// A black wall on a floor, a sun that shines slanting onto one side of it. On the dark side at the distance x < r the
/// disk holds a segment of lit floor: the strip's mean is E·(2/(3π))·r over its width; beyond r it is black.
TEST_F(HardMerging, LeaksUnderAWallAreTheBoundaryBias) {
    constexpr double radius = 0.1, strip = 0.2;
    MeanCase c{.group = kGroup, .difficulty = "floor behind a wall, strip of twice the merge radius"};
    addHorizontalSquare(c.scene, {0, 0, 0}, 2, addLambert(c.scene, Vec3f(float(kReflectance))));
    addQuad(c.scene, {0, 0, 1}, {0, 2, 0}, {0, 0, 1}, addLambert(c.scene, Vec3f(0.0f)));
    c.scene.directionalLights.push_back({{-0.6f, 0, -0.8f}, Vec3f(1.0f)});
    c.scene.camera = lookDownOn(-0.5 * strip, 0, 0.3, 0.5 * strip);
    c.settings = smallImage(16, radius);
    c.settings.lightPathCount = 65536;
    c.techniques = {"ppm"};
    c.iterations = 48;
    const double lit = kReflectance * 0.8 / std::numbers::pi;
    expectMean(c, lit * 2 / (3 * std::numbers::pi) * radius / strip);

    uint64_t bright = 0;
    for (const char* technique : {"ppm", "bpm", "vcm"}) {
        c.settings.technique = technique;
        c.scene.camera = lookDownOn(-0.5 * strip - 1.001 * radius, 0, 0.3, 0.5 * strip);
        bright += litPixels(c.scene, c.settings, 2);
        c.scene.camera = lookDownOn(0.5 * strip + 1.001 * radius, 0, 0.3, 0.5 * strip);
        EXPECT_EQ(litPixels(c.scene, c.settings, 1), 16u * 16) << technique << ", on the lit side";
    }
    expectMeasured({kGroup, "floor behind a wall, beyond the merge radius", "pixels that are not black", 0},
                   double(bright));
}

}  // namespace
}  // namespace antipode::test
