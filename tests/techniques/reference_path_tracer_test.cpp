// The engine against the double-precision path tracer of tests/support/reference, which shares no code with it: two
// scenes of random spheres, block by block.
//
// Statistics. Null hypothesis: in every block and channel both have the same expectation. The engine's samples are the
// block's means of single iterations, the reference's are those of independent images of one sample per pixel. Welch's
// test, α = .01 over all blocks, channels, techniques and scenes (Šidák). Blocks where either relative standard error
// exceeds kGreatestError are left out, since rare events are too far from normal; the whole image never is.
#include <cmath>
#include <sstream>

#include "support/random.h"
#include "support/reference/path_tracer.h"
#include "support/worst.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

// The same blocks in images of different sizes have the same expectation.
constexpr uint32_t kWidth = 32, kHeight = 24, kEngineScale = 3, kColumns = 4, kRows = 3;
constexpr uint64_t kEngineIterations = 48, kReferenceImages = 800;
constexpr double kGreatestError = 0.05;

class EngineAgainstReference : public EngineTest {
protected:
    void expectReference(const std::string& difficulty, const Scene& scene, uint64_t seed) {
        const std::vector<Image> expected = referenceImages(scene, seed);
        for (const char* technique : {"pt", "bpt", "vcm"}) {
            SCOPED_TRACE(technique);
            RenderSettings settings;
            settings.width = kEngineScale * kWidth;
            settings.height = kEngineScale * kHeight;
            settings.technique = technique;
            settings.seed = seed;
            settings.initialRadius = 0.01;  // a hundredth of a ball: merging's bias is of the order of 1e-4
            expectEqual(difficulty, renderEach(scene, settings, kEngineIterations), expected);
        }
    }

private:
    static std::vector<Image> referenceImages(const Scene& scene, uint64_t seed) {
        const reference::PathTracer tracer(scene);
        std::vector<Image> images;
        for (uint64_t i = 0; i < kReferenceImages; ++i) {
            Image image{kWidth, kHeight, {}};
            for (const auto& pixel : tracer.image(kWidth, kHeight, {}, 1, 1000 * seed + i))
                image.pixels.push_back(Vec3f(pixel.mean()));
            images.push_back(std::move(image));
        }
        return images;
    }

    static void expectEqual(const std::string& difficulty, const std::vector<Image>& engine,
                            const std::vector<Image>& reference) {
        Worst surprise;
        const std::vector<Block> blocks = blocksOf(kWidth, kHeight, kColumns, kRows);
        const std::vector<Block> engineBlocks =
            blocksOf(kEngineScale * kWidth, kEngineScale * kHeight, kColumns, kRows);
        for (size_t at = 0; at < blocks.size(); ++at)
            for (int channel = 0; channel < 3; ++channel) {
                const Moments a = momentsOf(engine, engineBlocks[at], channel);
                const Moments b = momentsOf(reference, blocks[at], channel);
                const double errorA = std::sqrt(a.meanVariance()) / a.mean();
                const double errorB = std::sqrt(b.meanVariance()) / b.mean();
                const bool sharp = errorA < kGreatestError && errorB < kGreatestError;
                if (at == 0)
                    EXPECT_TRUE(sharp) << errorA << ", reference " << errorB;
                else if (!sharp)
                    continue;
                std::ostringstream said;
                said << a.mean() << " instead of " << b.mean() << ", ratio " << a.mean() / b.mean() << " ± "
                     << std::hypot(errorA, errorB) << ", channel " << channel << ", block " << blocks[at].left << ","
                     << blocks[at].top;
                surprise.add(-std::log10(welchTest(a, b).pValue), said.str());
            }
        SCOPED_TRACE(surprise.where);
        expectWithin({"MIS", difficulty, "largest −log₁₀ p of Welch tests against the host's own renderer",
                      -std::log10(sidak(kAlpha, 2 * 3 * 3 * blocks.size()))},
                     surprise.value, deviceName());
    }
};

/// A floor and 24 balls at random, each of a random kind and colour; `kinds` to choose from.
Scene randomBalls(uint64_t seed, const std::vector<MaterialKind>& kinds) {
    Random random(seed);
    const auto between = [&](double low, double high) { return float(random.uniform(low, high)); };
    const auto colour = [&] { return Vec3f{between(0.2, 0.9), between(0.2, 0.9), between(0.2, 0.9)}; };
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 4, addLambert(scene, {0.7f, 0.6f, 0.5f}));
    for (int i = 0; i < 24; ++i) {
        const MaterialKind kind = kinds[random.index(uint32_t(kinds.size()))];
        const Vec3f base = colour();
        const uint32_t material = addMaterial(scene, kind, base, between(0.4, 0.9));
        Material& m = scene.materials[material];
        m.ior = between(1.2, 1.8);
        m.phongExponent = between(2, 30);
        m.specular = kind == MaterialKind::Phong ? Vec3f(1.0f) - base : colour();
        const float radius = between(0.2, 0.5);
        scene.spheres.push_back({{between(-2, 2), between(-2, 2), between(0.6, 2)}, radius, material});
    }
    scene.camera = lookAt({0, -7, 3}, {0, 0, 1}, {0, 0, 1}, 0.6);
    return scene;
}

/// Specular materials among the others; lights that can be hit, which is all that path tracing finds behind glass.
TEST_F(EngineAgainstReference, AreaLightsAndSky) {
    Scene scene =
        randomBalls(11, {MaterialKind::Lambert, MaterialKind::Phong, MaterialKind::Mirror, MaterialKind::Dielectric,
                         MaterialKind::RoughConductor, MaterialKind::RoughDielectric});
    addHorizontalSquare(scene, {0, 0, 4}, 1.5f, addLamp(scene, {3, 4, 5}), false);
    scene.spheres.push_back({{-2.5f, -1, 2.5f}, 0.5f, addLamp(scene, {6, 3, 2})});
    addQuad(scene, {2.8f, 0, 1.5f}, {0, 0.6f, 0}, {0, 0, 0.6f}, addLamp(scene, {2, 4, 2}, true));
    setConstantSky(scene, {0.2f, 0.3f, 0.4f});
    expectReference("random balls of all materials under lights that can be hit", scene, 1);
}

/// Lights that nothing can hit; nothing specular.
TEST_F(EngineAgainstReference, PointSpotAndSun) {
    Scene scene = randomBalls(
        12, {MaterialKind::Lambert, MaterialKind::Phong, MaterialKind::RoughConductor, MaterialKind::RoughDielectric});
    addPointLight(scene, {-1.5f, -2, 4}, {30, 20, 10});
    scene.spotLights.push_back({{2, -3, 4}, normalize(Vec3f{-2, 3, -3.5f}), {40, 60, 50}, 0.2f, 0.5f});
    scene.directionalLights.push_back({normalize(Vec3f{1, 2, -3}), {0.5f, 1, 2}});
    expectReference("random balls under lights that nothing can hit", scene, 2);
}

}  // namespace
}  // namespace antipode::test
