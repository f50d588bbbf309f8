// Paths of hundreds of edges: what a rounding does to each of them adds up, and nothing may end them early.
#include <algorithm>
#include <array>
#include <cmath>

#include "support/closed_forms.h"
#include "support/worst.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/row_names.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Long paths";

/// About the origin, with these half-edges; its front is outside.
void addBox(Scene& scene, Vec3f half, uint32_t material) {
    const Vec3f x{half.x, 0, 0}, y{0, half.y, 0}, z{0, 0, half.z};
    for (const auto& [axis, u, v] : {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}}) {
        addQuad(scene, axis, u, v, material);
        addQuad(scene, -axis, v, u, material);
    }
}

class LongPaths : public HardCaseTest {
protected:
    /// Largest relative difference of any pixel from `expected`, over all techniques, of scenes without variance.
    double greatestDifference(const Scene& scene, RenderSettings settings, double expected) {
        Worst greatest;
        for (const TechniqueInfo& technique : techniqueTable()) {
            settings.technique = technique.name;
            for (const Image& image : samplesOf(scene, settings, 1))
                for (const Vec3f& pixel : image.pixels) greatest.add(std::abs(double(pixel.y) / expected - 1));
        }
        return greatest.value;
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

/// Those that go through glass, in both precisions.
class LongPathsInGlass : public LongPaths, public testing::WithParamInterface<Precision> {
protected:
    static double unitRoundoff() { return GetParam() == Precision::Double ? 0x1p-53 : 0x1p-24; }
};
INSTANTIATE_TEST_SUITE_P(In, LongPathsInGlass, testing::Values(Precision::Float, Precision::Double), precisionName);

/// A plate of glass, 2000 times as long as it is thick, under a uniform sky, the camera at one end: total reflection
/// holds the light, .6 times for every thickness, up to the other end. What is reflected there, .06, comes back after
/// as many again; 6000 edges leave 1e-5 of it. Every pixel is n²L, of paths of at least 1000 edges, since shorter ones
/// do not count. Total reflection multiplies by 1; some roundings of the end's refraction and of the film are left. In
/// float, about one path in a thousand meets an end within rounding of its edge and leaves there with 1 instead of n²L;
/// none does with this seed.
TEST_P(LongPathsInGlass, GuideOfAThousandReflections) {
    constexpr float n = 1.5f, length = 1000;
    Scene scene;
    addBox(scene, {length, length, 0.5f}, addGlass(scene, n));
    setConstantSky(scene, Vec3f(1.0f));
    const Vec3f eye{1 - length, 0.1f, 0.2f};
    scene.camera = lookAt(eye, eye + Vec3f{1, 0.01f, 0.6f}, {0, 1, 0}, 1e-3);
    RenderSettings settings = smallImage(8, 0.1);
    settings.precision = GetParam();
    settings.seed = 2;
    settings.russianRoulette = false;
    settings.minPathLength = 1000;
    settings.maxPathLength = 6000;
    expectMeasured({kGroup, "light guide of glass, 1000 total reflections", "largest relative error of a pixel", 1e-6},
                   greatestDifference(scene, settings, closed_forms::radianceInsideGlass(double(n), 1)), GetParam());
}

/// A cube of index 2.4 under a uniform sky, the camera inside: a direction with no component beyond cos of the critical
/// angle, .909, never gets out, and is black; any other has n²L after some hundred inner reflections at most. Pixels
/// within .03 of the border between the two are left out. A hit of some 16 rounded operations next to one of the four
/// edges of a face of 2 × 2 may lie beyond it, and lets its path out.
TEST_P(LongPathsInGlass, CubeThatTrapsLight) {
    constexpr float n = 2.4f;
    constexpr uint32_t size = 48, reflections = 1000;
    const double inside = closed_forms::radianceInsideGlass(double(n), 1);
    Scene scene;
    addBox(scene, Vec3f(1.0f), addGlass(scene, n));
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0.1f, -0.2f, 0.3f}, {1, 0.6f, 0.7f}, {0, 1, 0}, 1.2);
    RenderSettings settings = smallImage(size, 0.1);
    settings.precision = GetParam();
    settings.russianRoulette = false;
    settings.maxPathLength = reflections;
    const double border = std::sqrt(1 - 1 / (double(n) * double(n)));
    const Vec3d forward(scene.camera.forward), right = normalize(cross(forward, Vec3d(scene.camera.up)));
    const Vec3d up = cross(right, forward);
    Worst error;
    uint64_t trapped = 0, leaked = 0, free = 0;
    for (const char* technique : {"pt", "bpt", "vcm", "bpm"}) {
        settings.technique = technique;
        for (const Image& image : samplesOf(scene, settings, 2))
            for (uint32_t i = 0; i < size * size; ++i) {
                const double scale = std::tan(0.6) / (0.5 * size);
                const double x = i % size + 0.5 - 0.5 * size, y = 0.5 * size - (i / size + 0.5);
                const Vec3d d = normalize(forward + right * (x * scale) + up * (y * scale));
                const double greatest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
                if (std::abs(greatest - border) < 0.03) continue;
                const double value = image.pixels[i].y;
                if (greatest < border) {
                    ++trapped;
                    leaked += value != 0;
                } else {
                    ++free;
                    error.add(std::abs(value / inside - 1));
                }
            }
    }
    EXPECT_GT(trapped, 100u);
    EXPECT_GT(free, 100u);
    const std::string difficulty = "camera in a cube of index 2.4 that traps light, 1000 edges";
    expectMeasured({kGroup, difficulty, "leaks per reflection of trapped paths", 2 * 16 * unitRoundoff()},
                   double(leaked) / (double(trapped) * reflections), GetParam());
    expectMeasured({kGroup, difficulty, "largest error of a pixel that is not trapped, relative to n²L", 1e-4},
                   error.value, GetParam());
}

/// Such a cube with a point light in it, inside a grey sphere: only light paths reach the wall. Most are trapped until
/// roulette ends them. The area of a sphere within a distance is that of the disk, and merging's bias r²/8·∇²L/L of
/// 1e-4 for a curvature of 1 is far below the standard errors.
TEST_F(LongPaths, LightThatIsTrappedInGlass) {
    MeanCase c{.group = kGroup, .difficulty = "point light in a cube of index 2.4 that traps most of its light"};
    addBox(c.scene, Vec3f(0.2f), addGlass(c.scene, 2.4f));
    c.scene.spheres.push_back({{0, 0, 0}, 1, addLambert(c.scene, Vec3f(0.5f))});
    addPointLight(c.scene, {0.01f, 0.02f, 0.03f}, Vec3f(1.0f));
    c.scene.camera = lookAt({-0.3f, -0.4f, -0.5f}, {-1, -1, 0}, {0, 1, 0}, 1.5);
    c.settings = smallImage(12, 0.03);
    c.settings.lightPathCount = 8192;
    c.settings.maxPathLength = 1000;
    c.techniques = {"lt", "bpt", "vcm", "bpm"};
    c.iterations = 24;
    expectAgreement(c);
}

}  // namespace
}  // namespace antipode::test
