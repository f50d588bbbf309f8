// Geometry that is hard to intersect, in renders. In a furnace whose surfaces reflect ½ and emit ½ under a sky of 1,
// everything has the radiance 1, whatever the geometry: rays that meet a surface twice, miss it or start inside it show
// only where they break the rule, as NaN or as energy from nowhere. Where a miss must show, there are shadows.
#include <cmath>

#include "support/random.h"
#include "tests/techniques/closed_form_scenes.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Intersection";

class RenderedGeometry : public HardCaseTest {
protected:
    static MeanCase furnace(const std::string& difficulty) {
        MeanCase c{.group = kGroup, .difficulty = difficulty};
        const uint32_t grey = addLambert(c.scene, Vec3f(0.5f));
        c.scene.materials[grey].emission = Vec3f(0.5f);
        c.scene.materials[grey].emitsBothSides = true;
        setConstantSky(c.scene, Vec3f(1.0f));
        c.settings = smallImage(24, 0.01);
        c.settings.lightPathCount = 2048;
        c.techniques = {"pt", "pt-naive", "bpt", "vcm"};
        return c;
    }
};

/// Slivers and triangles of no area at all among sound ones.
TEST_F(RenderedGeometry, NeedlesAndDegenerateTriangles) {
    MeanCase c = furnace("200 needles down to 1e-9 of their length, 60 triangles without area");
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
    c.scene.meshes.push_back(mesh);
    c.scene.camera = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.5);
    expectMean(c, 1);
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
    for (const char* technique : {"pt", "bpt", "vcm", "bpm"}) {
        SCOPED_TRACE(technique);
        settings.technique = technique;
        const std::vector<Image> images = samplesOf(scene, settings, 24);
        const Moments red = momentsOf(images, {0, 0, 24, 24}, 0), green = momentsOf(images, {0, 0, 24, 24}, 1);
        const double t = std::abs(tTest(red, 0.5).statistic);
        worst = std::max(worst, t);
        EXPECT_LE(std::sqrt(red.meanVariance()), 0.01);
        EXPECT_GE(green.mean(), 0.3 - 4 * std::sqrt(green.meanVariance()));
        EXPECT_LE(green.mean(), 0.6 + 4 * std::sqrt(green.meanVariance()));
        EXPECT_EQ(renderSums(scene, settings, {1, 2}).sha256(), renderSums(scene, settings, {2, 1}).sha256());
    }
    // Student's t with 23 degrees of freedom, α = .01 over four tests.
    expectMeasured({kGroup, "two coincident squares of different materials", "largest |t| of 4 tests", 3.36}, worst);
}

/// The camera's place is no surface of the scene, or lies on one, or in a solid: light where there is some, else black.
TEST_F(RenderedGeometry, CameraInASolid) {
    Scene scene;
    const uint32_t grey = addLambert(scene, Vec3f(0.5f));
    scene.spheres.push_back({{0, 0, 0}, 1, grey});
    addGeodesicSphere(scene, {4, 0, 0}, 1, 2, true, false, grey);
    setConstantSky(scene, Vec3f(1.0f));
    RenderSettings settings = smallImage(16, 0.02);
    uint64_t lit = 0;
    for (const Vec3f& at : {Vec3f{0.3f, 0.2f, 0.1f}, Vec3f{4.3f, 0.2f, 0.1f}}) {
        scene.camera = lookAt(at, at + Vec3f{0, 0, 1}, {0, 1, 0}, 1.5);
        for (const TechniqueInfo& technique : techniqueTable()) {
            settings.technique = technique.name;
            for (const Image& image : samplesOf(scene, settings, 2))
                for (const Vec3f& pixel : image.pixels) lit += pixel.y != 0;
        }
    }
    expectMeasured({kGroup, "camera inside a closed ball", "pixels that are not black", 0}, double(lit));
}

TEST_F(RenderedGeometry, CameraOnASurface) {
    MeanCase c = furnace("camera on a triangle, looking along it");
    addHorizontalSquare(c.scene, {0, 0, 0}, 1, 0);
    c.scene.camera = lookAt({0.1f, 0.2f, 0}, {1, 0.2f, 0}, {0, 0, 1}, 1.0);
    expectMean(c, 1);
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
