// Images of every shape: each pixel, the first and last row and column among them, gets what is its.
#include <algorithm>
#include <cmath>

#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Images";

struct Shape {
    uint32_t width, height;
};

/// Perspective that keeps the wider half-angle at atan .4.
Camera inside(const Shape& shape) {
    const double tangent = 0.4 * std::min(1.0, double(shape.height) / shape.width);
    return lookAt({0.1f, 0.2f, 0.3f}, {0.5f, -0.3f, 2}, {0, 1, 0}, 2 * std::atan(tangent));
}

std::string nameOfShape(const Shape& s) { return std::to_string(s.width) + "x" + std::to_string(s.height); }

class ImageShapes : public HardCaseTest, public testing::WithParamInterface<Shape> {};

/// A mirror sphere of reflectance ½ that emits ½, seen from inside: 1 in every pixel, but for 2^-64.
TEST_P(ImageShapes, EveryPixelOfAMirrorFurnaceIsRight) {
    Scene scene;
    const uint32_t mirror = addMirror(scene, 0.5f, 0.5f);
    scene.materials[mirror].emitsBothSides = true;
    scene.spheres.push_back({{0, 0, 0}, 1, mirror});
    scene.camera = inside(GetParam());
    RenderSettings settings = smallImage(1, 0.1);
    settings.width = GetParam().width;
    settings.height = GetParam().height;
    settings.russianRoulette = false;
    settings.maxPathLength = 64;
    double worst = 0;
    for (const char* technique : {"pt", "vcm"}) {
        settings.technique = technique;
        for (const Image& image : samplesOf(scene, settings, 1)) {
            EXPECT_EQ(image.pixels.size(), size_t(settings.width) * settings.height);
            for (const Vec3f& pixel : image.pixels)
                for (int channel = 0; channel < 3; ++channel)
                    worst = std::max(worst, std::abs(double(pixel[channel]) - 1));
        }
    }
    expectMeasured({kGroup, "mirror furnace, " + nameOfShape(GetParam()) + " pixels", "largest error of a pixel", 1e-6},
                   worst);
}

/// A grey furnace: splats, too, have to meet the right pixel. Borders apart, whole columns and rows.
TEST_P(ImageShapes, BordersOfAGreyFurnaceHaveTheMean) {
    const uint32_t w = GetParam().width, h = GetParam().height;
    MeanCase c{.group = kGroup, .difficulty = "grey furnace, " + nameOfShape(GetParam()) + " pixels, border by border"};
    const uint32_t wall = addLambert(c.scene, Vec3f(0.5f));
    c.scene.materials[wall].emission = Vec3f(0.5f);
    c.scene.materials[wall].emitsBothSides = true;
    c.scene.spheres.push_back({{0, 0, 0}, 1, wall});
    c.scene.camera = inside(GetParam());
    c.settings = smallImage(1, 0.1);
    c.settings.width = w;
    c.settings.height = h;
    c.settings.lightPathCount = 2048;
    c.blocks = {{0, 0, w, h}};
    if (w > 1) c.blocks.insert(c.blocks.end(), {{0, 0, 1, h}, {w - 1, 0, w, h}});
    if (h > 1) c.blocks.insert(c.blocks.end(), {{0, 0, w, 1}, {0, h - 1, w, h}});
    c.techniques = {"pt", "bpt", "vcm"};
    if (w < 4096 && h < 4096) c.techniques.push_back("lt");  // splats all but miss the narrow ones
    c.iterations = 32;
    c.greatestError = 0.3;  // of single pixels, which lt's splats rarely meet
    expectMeans(c, std::vector<double>(c.blocks.size(), 1.0));
}

INSTANTIATE_TEST_SUITE_P(Of, ImageShapes,
                         testing::Values(Shape{1, 1}, Shape{7, 5}, Shape{33, 17}, Shape{1, 4096}, Shape{4096, 1}),
                         [](const auto& shape) { return nameOfShape(shape.param); });

}  // namespace
}  // namespace antipode::test
