// A scene scaled by a power of two gives the same bytes, by a power of ten the same image within rounding: no length in
// the engine is absolute.
#include <cmath>

#include "proto/scene_loader.h"
#include "support/worst.h"
#include "tests/techniques/differing_sums.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

/// Every length × f; intensities × f², which keeps the irradiance.
Scene scaled(Scene scene, float f) {
    for (Mesh& mesh : scene.meshes)
        for (Vec3f& p : mesh.positions) p *= f;
    for (Sphere& s : scene.spheres) s.center *= f, s.radius *= f;
    for (PointLight& l : scene.pointLights) l.position *= f, l.intensity *= f * f;
    scene.camera.position *= f;
    scene.camera.focusDistance *= f;
    scene.camera.lensRadius *= f;
    return scene;
}

class EngineScale : public EngineTest, public testing::WithParamInterface<const char*> {};

TEST_P(EngineScale, PowersOfTwoGiveTheSameBytes) {
    const Scene scene = loadScene(std::string(ANTIPODE_SOURCE_DIR) + "/scenes/cornell/" + GetParam() + ".textproto");
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    for (const Precision precision : {Precision::Float, Precision::Double}) {
        settings.precision = precision;
        const FilmSums expected = renderSums(scene, settings, {1, 2});
        for (const int exponent : {-60, -20, -10, -1, 1, 10, 20, 60}) {
            SCOPED_TRACE(exponent);
            expectWithin(
                {"Scale", "all lengths × 2ᵏ, k from −60 to 60", "sums of the film that differ", 0},
                differingSums(renderSums(scaled(scene, std::ldexp(1.0f, exponent)), settings, {1, 2}), expected),
                deviceName(), precision);
        }
    }
}

// Null hypothesis: the differences between iterations of the scaled scene and of the scene have expectation 0, in the
// whole image and in each of four blocks. The random numbers are the same, so that little but rounding is left in them.
// Seed 1, α = .01 over all scales and blocks.
TEST_P(EngineScale, PowersOfTenGiveTheSameImage) {
    const Scene scene = loadScene(std::string(ANTIPODE_SOURCE_DIR) + "/scenes/cornell/" + GetParam() + ".textproto");
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    constexpr int leastPower = -4, greatestPower = 5;
    constexpr uint64_t iterations = 12;
    const std::vector<Block> blocks = blocksOf(settings.width, settings.height, 2, 2);
    const double alpha = sidak(kAlpha, blocks.size() * (greatestPower - leastPower));
    const std::vector<Image> expected = renderEach(scene, settings, iterations);
    for (int power = leastPower; power <= greatestPower; ++power) {
        if (power == 0) continue;
        const auto images = renderEach(scaled(scene, float(std::pow(10.0, power))), settings, iterations);
        Worst surprise;
        for (size_t b = 0; b < blocks.size(); ++b) {
            Moments differences;
            double mean = 0;
            for (size_t i = 0; i < iterations; ++i) {
                differences.add(meanOf(images[i], blocks[b], 1) - meanOf(expected[i], blocks[b], 1));
                mean += meanOf(expected[i], blocks[b], 1) / iterations;
            }
            surprise.add(-std::log10(tTest(differences, 0).pValue),
                         "block " + std::to_string(b) + " differs by " + std::to_string(differences.mean() / mean));
        }
        SCOPED_TRACE(testing::Message() << "10^" << power << ": " << surprise.where);
        expectWithin({"Scale", "all lengths × 10ᵏ, k from −4 to 5",
                      "largest −log₁₀ p of t-tests over blocks and scales", -std::log10(alpha)},
                     surprise.value, deviceName());
    }
}

// Area lights and mirrors; points and glass; a constant environment.
INSTANTIATE_TEST_SUITE_P(Cornell, EngineScale, testing::Values("area", "point", "sky"),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace antipode::test
