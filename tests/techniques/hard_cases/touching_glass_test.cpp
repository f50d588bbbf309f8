// Transparent bodies that touch, share a part of a face, nest or overlap, of any tessellation and turned at will.
//
// Without roulette and in uniform light every path of smooth interfaces carries exactly that light: each pixel of one
// iteration is compared, so that a single path which takes one face for another is seen. Where something scatters,
// techniques are compared with each other (hard_case_fixture.h).
#include <cmath>

#include "support/worst.h"
#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/row_names.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

/// A rotation about a slanted axis and a shift, or neither.
Vec3f placed(const Vec3f& p, bool turned) {
    if (!turned) return p;
    const Vec3d axis = normalize(Vec3d(1, 2, 0.5)), v(p);
    const double c = std::cos(0.65), s = std::sin(0.65);
    return Vec3f(v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c)) + Vec3d(0.3, 0.2, -0.1));
}

void addBox(Scene& scene, uint32_t material, const Vec3f& low, const Vec3f& high, bool turned) {
    Mesh mesh;
    mesh.material = material;
    for (uint32_t i = 0; i < 8; ++i)
        mesh.positions.push_back(placed(
            {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z}, turned));
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    scene.meshes.push_back(std::move(mesh));
}

Scene skyScene() {
    Scene scene;
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({2, 1.5f, 4}, {0.1f, 0, 0}, {0, 1, 0}, 0.5);
    return scene;
}

/// Glass on water: a whole face, a part of one, or one that reaches into it by `overlap`.
Scene twoBoxes(float waterSize, float overlap, bool turned) {
    Scene scene = skyScene();
    addBox(scene, addGlass(scene, 1.5f), {-1, -1, -overlap}, {1, 1, 1}, turned);
    addBox(scene, addGlass(scene, 1.33f), Vec3f(-waterSize, -waterSize, -1), Vec3f(waterSize, waterSize, 0), turned);
    return scene;
}

/// A tumbler of liquid and ice, all of them solid bodies: what is nested wins. The ice reaches out of the liquid.
Scene tumbler() {
    Scene scene = skyScene();
    addBox(scene, addGlass(scene, 1.5f), {-0.8f, -1, -0.8f}, {0.8f, 1, 0.8f}, true);
    const uint32_t liquid = addGlass(scene, 1.33f), ice = addGlass(scene, 1.31f), air = addGlass(scene, 1.0f);
    addBox(scene, air, {-0.7f, 0.3f, -0.7f}, {0.7f, 1, 0.7f}, true);
    addBox(scene, liquid, {-0.7f, -0.9f, -0.7f}, {0.7f, 0.3f, 0.7f}, true);
    addBox(scene, ice, {-0.2f, 0.1f, -0.3f}, {0.3f, 0.5f, 0.2f}, true);
    scene.spheres.push_back({placed({0, -0.9f, 0}, true), 0.3f, ice});
    return scene;
}

/// A marble half in water, and spheres that reach into each other.
Scene marbles() {
    Scene scene = skyScene();
    addBox(scene, addGlass(scene, 1.33f), {-1.5f, -1, -1.5f}, {1.5f, 0, 1.5f}, false);
    const uint32_t glass = addGlass(scene, 1.5f);
    scene.spheres.push_back({{0, 0, 0}, 0.6f, glass});
    scene.spheres.push_back({{0.5f, 0.2f, 0.4f}, 0.4f, addGlass(scene, 1.7f)});
    scene.spheres.push_back({{0.5f, 0.2f, 1.1f}, 0.3f, glass});
    return scene;
}

struct NamedScene {
    const char* difficulty;
    Scene scene;
};

class TouchingGlass : public HardCaseTest, public testing::WithParamInterface<Precision> {};

TEST_P(TouchingGlass, CreatesNoLight) {
    const NamedScene scenes[] = {
        {"glass on water, a shared face", twoBoxes(1, 0, false)},
        {"glass on water, a shared face at a slant", twoBoxes(1, 0, true)},
        {"glass on water, a part of a face at a slant", twoBoxes(0.4f, 0, true)},
        {"glass in water by a hair", twoBoxes(1, 1e-6f, true)},
        {"glass in water by a lot", twoBoxes(1.2f, 0.5f, true)},
        {"glass over water by less than rays keep off", twoBoxes(1, -1e-6f, true)},
        {"a tumbler with liquid and ice", tumbler()},
        {"marbles half in water and in each other", marbles()},
    };
    for (const NamedScene& s : scenes)
        for (const TechniqueInfo& technique : techniqueTable()) {
            SCOPED_TRACE(std::string(s.difficulty) + ", " + technique.name);
            RenderSettings settings = smallImage(96, 0.05);
            settings.technique = technique.name;
            settings.precision = GetParam();
            settings.russianRoulette = false;
            settings.maxPathLength = 400;
            Worst error;
            for (const Image& image : samplesOf(s.scene, settings, 1))
                for (const Vec3f& pixel : image.pixels) error.add(std::abs(double(pixel.y) - 1));
            expectMeasured({"Intersection", s.difficulty, "largest error of a path in uniform light", 1e-5},
                           error.value, GetParam());
        }
}

/// A slab of water between two of glass that touch it, before a lamp, seen at a right angle: Fresnel's coefficients of
/// the four interfaces, whose ratios are those of the neighbours.
TEST_P(TouchingGlass, PassesWhatOneInterfacePasses) {
    Scene scene;
    const uint32_t glass = addGlass(scene, 1.5f), water = addGlass(scene, 1.33f);
    addQuad(scene, {0, 0, -10}, {50, 0, 0}, {0, 50, 0}, addLamp(scene, Vec3f(1.0f)));
    addBox(scene, glass, {-40, -40, 1}, {40, 40, 1.5f}, false);
    addBox(scene, glass, {-40, -40, -1.5f}, {40, 40, -1}, false);
    addBox(scene, water, {-40, -40, -1}, {40, 40, 1}, false);
    scene.camera = lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.03);
    // Layers in series without interference: T = 1/(1 + Σ R/(1−R)).
    const auto opacity = [](double a, double b) {
        const double r = (a - b) * (a - b) / ((a + b) * (a + b));
        return r / (1 - r);
    };
    const double expected = 1 / (1 + 2 * opacity(1, 1.5) + 2 * opacity(1.5, 1.33));
    MeanCase c{"Intersection", "a slab of water between slabs of glass", scene, smallImage(16, 0.05), {}};
    for (const TechniqueInfo& technique : techniqueTable()) c.techniques.push_back(technique.name);
    c.settings.precision = GetParam();
    expectMean(c, expected);
}

/// A rough bottom and a lamp under water, in a basin whose walls the water touches: connections and merges inside the
/// medium. Light tracing alone has not all of it: what the surface mirrors from below.
TEST_P(TouchingGlass, LightsAgreeUnderWater) {
    Scene scene;
    setConstantSky(scene, Vec3f(0.2f));
    const uint32_t wall = addLambert(scene, Vec3f(0.6f)), water = addGlass(scene, 1.33f);
    addBox(scene, wall, {-1.2f, -1.2f, -1.2f}, {1.2f, -1, 1.2f}, false);
    addBox(scene, wall, {-1.2f, -1, -1.2f}, {-1, 0.1f, 1.2f}, false);
    addBox(scene, wall, {1, -1, -1.2f}, {1.2f, 0.1f, 1.2f}, false);
    addBox(scene, wall, {-1, -1, -1.2f}, {1, 0.1f, -1}, false);
    addBox(scene, wall, {-1, -1, 1}, {1, 0.1f, 1.2f}, false);
    addBox(scene, water, {-1, -1, -1}, {1, 0, 1}, false);
    Material rough;
    rough.kind = MaterialKind::RoughDielectric;
    rough.roughness = 0.5f;
    rough.ior = 1.5f;
    scene.materials.push_back(rough);
    scene.spheres.push_back({{0.3f, -0.3f, 0.2f}, 0.4f, uint32_t(scene.materials.size() - 1)});
    scene.spheres.push_back({{-0.5f, -0.6f, 0}, 0.2f, addLamp(scene, Vec3f(3.0f))});
    scene.camera = lookAt({0.3f, -0.2f, 0.9f}, {-0.1f, -0.6f, -0.2f}, {0, 1, 0}, 1.0);
    MeanCase c{"Lights",
               "lamp and camera under water that fills a basin",
               scene,
               smallImage(32, 0.03),
               {"pt", "pt-naive", "bpt", "vcm", "bpm"}};
    c.settings.precision = GetParam();
    c.settings.lightPathCount = 4096;
    c.iterations = 32;
    c.mergeBias = 0.01;
    expectAgreement(c);
}

INSTANTIATE_TEST_SUITE_P(In, TouchingGlass, testing::Values(Precision::Float, Precision::Double), precisionName);

}  // namespace
}  // namespace antipode::test
