// Geometry that is hard to intersect, in renders whose right image is known: from closed forms, or from the path tracer
// of tests/support/reference, which computes in double and shares no code with the engine. A surface always differs
// from what is behind it, so that a miss shows as much as a hit too many.
#include <cmath>

#include "support/random.h"
#include "support/reference/path_tracer.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Intersection";

class RenderedGeometry : public HardCaseTest {
protected:
    /// Pixels of which a channel is not 0, over two iterations of every technique.
    uint64_t litPixels(const Scene& scene, RenderSettings settings) {
        uint64_t lit = 0;
        for (const TechniqueInfo& technique : techniqueTable()) {
            settings.technique = technique.name;
            for (const Image& image : samplesOf(scene, settings, 2))
                for (const Vec3f& pixel : image.pixels) lit += pixel.x != 0 || pixel.y != 0 || pixel.z != 0;
        }
        return lit;
    }
};

/// Slivers and triangles of no area at all among sound ones, all of which reflect ½ and emit a quarter of the sky.
Scene needles() {
    Scene scene;
    const uint32_t grey = addLambert(scene, Vec3f(0.5f));
    scene.materials[grey].emission = Vec3f(0.25f);
    scene.materials[grey].emitsBothSides = true;
    setConstantSky(scene, Vec3f(1.0f));
    Random random(5);
    const auto point = [&] {
        return Vec3f(Vec3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    };
    Mesh mesh;
    const auto add = [&](const Vec3f& p, const Vec3f& q, const Vec3f& r) {
        const auto first = uint32_t(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {p, q, r});
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 200; ++i) {
        const Vec3f p = point(), q = point();
        add(p, q, p + (q - p) * 0.5f + point() * float(std::pow(10.0, -1 - i % 9)));
    }
    for (int i = 0; i < 20; ++i) {
        const Vec3f p = point(), q = point();
        add(p, p, p);
        add(p, q, q);
        add(p, p + Vec3f(0.5f, 0, 0), p + Vec3f(0.25f, 0, 0));
    }
    for (int i = 0; i < 40; ++i) add(point(), point(), point());
    scene.meshes.push_back(mesh);
    scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.5);
    return scene;
}

/// Null hypothesis: in every block, engine and reference have the same expectation. Welch's test over iterations and
/// over independent reference images, α = .01 over all blocks and techniques (Šidák).
TEST_F(RenderedGeometry, NeedlesAndDegenerateTriangles) {
    constexpr uint32_t size = 24;
    const Scene scene = needles();
    const reference::PathTracer tracer(scene);
    std::vector<Image> expected;
    for (uint64_t i = 0; i < 64; ++i) {
        Image image{size, size, {}};
        for (const auto& pixel : tracer.image(size, size, {}, 1, i)) image.pixels.push_back(Vec3f(pixel.mean()));
        expected.push_back(std::move(image));
    }
    RenderSettings settings = smallImage(size, 0.01);
    settings.lightPathCount = 2048;
    const std::vector<Block> blocks = blocksOf(size, size, 4, 4);
    const std::vector<const char*> techniques{"pt", "pt-naive", "bpt", "vcm"};
    double surprise = 0;
    for (const char* technique : techniques) {
        settings.technique = technique;
        const std::vector<Image> images = samplesOf(scene, settings, 48);
        for (const Block& block : blocks) {
            const Moments engine = momentsOf(images, block, 1), reference = momentsOf(expected, block, 1);
            EXPECT_LE(std::sqrt(engine.meanVariance() + reference.meanVariance()), 0.03 * reference.mean())
                << technique << ", block " << block.left << "," << block.top;
            surprise = std::max(surprise, -std::log10(welchTest(engine, reference).pValue));
        }
    }
    expectMeasured({kGroup, "200 needles down to 1e-9 of their length, 60 triangles without area",
                    "largest −log₁₀ p of Welch tests against the host's own renderer",
                    -std::log10(sidak(kAlpha, techniques.size() * blocks.size()))},
                   surprise);
}

/// Two squares in the same plane, one triangulated along the other diagonal. In the first channel both reflect ½; in
/// the second one reflects .3, the other .6: whichever is met, the mean lies between.
TEST_F(RenderedGeometry, CoincidentFaces) {
    Scene scene;
    const uint32_t first = addLambert(scene, {0.5f, 0.3f, 0.3f}), second = addLambert(scene, {0.5f, 0.6f, 0.6f});
    addHorizontalSquare(scene, {0, 0, 0}, 1, first);
    addQuad(scene, {0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, second);
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookDownOn(0, 0, 1, 0.5);
    RenderSettings settings = smallImage(24, 0.02);
    settings.lightPathCount = 4096;
    double worst = 0;
    const std::vector<const char*> techniques{"pt", "bpt", "vcm", "bpm"};
    for (const char* technique : techniques) {
        SCOPED_TRACE(technique);
        settings.technique = technique;
        const std::vector<Image> images = samplesOf(scene, settings, 24);
        const Moments red = momentsOf(images, {0, 0, 24, 24}, 0), green = momentsOf(images, {0, 0, 24, 24}, 1);
        worst = std::max(worst, -std::log10(tTest(red, 0.5).pValue));
        EXPECT_LE(std::sqrt(red.meanVariance()), 0.01);
        EXPECT_GE(green.mean(), 0.3 - 4 * std::sqrt(green.meanVariance()));
        EXPECT_LE(green.mean(), 0.6 + 4 * std::sqrt(green.meanVariance()));
        EXPECT_EQ(renderSums(scene, settings, {1, 2}).sha256(), renderSums(scene, settings, {2, 1}).sha256());
    }
    expectMeasured({kGroup, "two coincident squares of different materials", "largest −log₁₀ p of 4 t-tests",
                    -std::log10(sidak(kAlpha, techniques.size()))},
                   worst);
}

/// Inside an opaque ball, of either kind, everything is black; just outside, nothing is.
TEST_F(RenderedGeometry, CameraInASolid) {
    Scene scene;
    const uint32_t grey = addLambert(scene, Vec3f(0.5f));
    scene.spheres.push_back({{0, 0, 0}, 1, grey});
    addGeodesicSphere(scene, {4, 0, 0}, 1, 2, true, false, grey);
    setConstantSky(scene, Vec3f(1.0f));
    const RenderSettings settings = smallImage(16, 0.02);
    uint64_t lit = 0;
    for (const Vec3f& at : {Vec3f{0.3f, 0.2f, 0.1f}, Vec3f{4.3f, 0.2f, 0.1f}}) {
        scene.camera = lookAt(at, at + Vec3f{0, 0, 1}, {0, 1, 0}, 1.5);
        lit += litPixels(scene, settings);
        scene.camera = lookAt(at + Vec3f{0, 0, 2}, at, {0, 1, 0}, 0.5);
        EXPECT_GT(litPixels(scene, settings), 0u) << "from outside";
    }
    expectMeasured({kGroup, "camera inside a closed ball", "pixels that are not black", 0}, double(lit));
}

/// The camera lies on a black square: every ray leaves it, and the sky is 1. A ray that met the square would be black.
TEST_F(RenderedGeometry, CameraOnASurface) {
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 1, addLambert(scene, Vec3f(0.0f)));
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0.1f, 0.2f, 0}, {1, 0.2f, 0}, {0, 0, 1}, 1.0);
    RenderSettings settings = smallImage(24, 0.01);
    double worst = 0;
    for (const TechniqueInfo& technique : techniqueTable()) {
        settings.technique = technique.name;
        for (const Image& image : samplesOf(scene, settings, 4))
            for (const Vec3f& pixel : image.pixels) worst = std::max(worst, std::abs(double(pixel.y) - 1));
    }
    expectMeasured({kGroup, "camera on a black triangle, looking along it", "largest error of a pixel", 1e-6}, worst);

    // The same square is seen, and black, from just above.
    scene.camera.position.z = 1e-3f;
    settings.technique = "pt";
    EXPECT_LT(meanOf(samplesOf(scene, settings, 1).front(), {0, 16, 24, 24}, 1), 0.01);
}

/// A floor and the arithmetic that has to place a shadow on it.
struct Floor {
    double halfWidth;
    Precision precision = Precision::Float;
};

/// The shadow of a ball of radius 1e-3 that floats its radius above a floor up to 10^9 times as large, under a sun from
/// above: .65 of what the camera, below the ball, sees. Positions on the floor are weighted means of its triangles'
/// corners, so that they err by roundings of the floor's size, and the shadow's border with them.
class HugeBesideTiny : public HardCaseTest, public testing::WithParamInterface<Floor> {};
TEST_P(HugeBesideTiny, ShadowHasItsArea) {
    const double w = GetParam().halfWidth, radius = 1e-3;
    char difficulty[80];
    std::snprintf(difficulty, sizeof difficulty, "shadow of a ball of radius 1e-3 on a floor of half-width %g", w);
    MeanCase c{.group = kGroup, .difficulty = difficulty};
    addHorizontalSquare(c.scene, {0, 0, 0}, float(w), addLambert(c.scene, Vec3f(0.5f)));
    c.scene.spheres.push_back({{0, 0, float(2 * radius)}, float(radius), addLambert(c.scene, Vec3f(0.0f))});
    c.scene.directionalLights.push_back({{0, 0, -1}, Vec3f(1.0f)});
    c.scene.camera = lookDownOn(0, 0, 0.9 * radius, 1.1 * radius);
    c.settings = smallImage(32, 0.1 * radius);
    c.settings.precision = GetParam().precision;
    c.techniques = {"pt", "bpt", "vcm"};
    c.iterations = 8;
    const double roundoff = GetParam().precision == Precision::Double ? 0x1p-53 : 0x1p-24;
    c.bias = 0.25 * roundoff * w / radius;
    const double dark = std::numbers::pi / (4 * 1.1 * 1.1);
    expectMean(c, 0.5 / std::numbers::pi * (1 - dark));
}
INSTANTIATE_TEST_SUITE_P(Floor, HugeBesideTiny,
                         testing::Values(Floor{1}, Floor{1e2}, Floor{1, Precision::Double},
                                         Floor{1e6, Precision::Double}),
                         [](const auto& f) {
                             return "TenTo" + std::to_string(int(std::lround(std::log10(f.param.halfWidth)))) +
                                    (f.param.precision == Precision::Double ? "InDouble" : "");
                         });

}  // namespace
}  // namespace antipode::test
