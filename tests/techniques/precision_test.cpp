// Kernels in double: the same random numbers as in float, so that the two differ by float's error alone.
#include <algorithm>
#include <cmath>

#include "support/hard_case.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

class PrecisionTest : public EngineTest {
protected:
    static constexpr uint32_t side = 48;

    /// A corner of two walls and a floor of several materials under a lamp: paths of three edges, without refraction.
    static Scene corner() {
        Scene scene;
        const uint32_t white = addLambert(scene, {0.7f, 0.6f, 0.5f});
        const uint32_t glossy = addMaterial(scene, MaterialKind::RoughConductor, {0.9f, 0.8f, 0.6f}, 0.5f);
        addHorizontalSquare(scene, {0, 0, 0}, 1, white);
        addQuad(scene, {0, 1, 1}, {1, 0, 0}, {0, 0, 1}, glossy);
        addQuad(scene, {-1, 0, 1}, {0, 1, 0}, {0, 0, 1}, white);
        addHorizontalSquare(scene, {0.2f, 0.3f, 1.9f}, 0.3f, addLamp(scene, Vec3f(5.0f), false), false);
        scene.camera = lookAt({1.5f, -2.5f, 1.5f}, {0, 0.3f, 0.6f}, {0, 0, 1}, 0.6);
        return scene;
    }

    std::vector<Image> render(const std::string& technique, Precision precision, uint64_t seed = 1) {
        RenderSettings settings;
        settings.width = settings.height = side;
        settings.technique = technique;
        settings.initialRadius = 0.1;
        settings.maxPathLength = 3;
        settings.russianRoulette = false;
        settings.precision = precision;
        settings.seed = seed;
        return renderEach(corner(), settings, 2);
    }

    /// Share of the pixels that differ by more than `tolerance` of the greater one's largest channel.
    static double differingShare(const std::vector<Image>& a, const std::vector<Image>& b, double tolerance) {
        double differing = 0, count = 0;
        for (size_t i = 0; i < a.size(); ++i)
            for (size_t p = 0; p < a[i].pixels.size(); ++p) {
                double difference = 0, greatest = 0;
                for (int c = 0; c < 3; ++c) {
                    const double x = double(a[i].pixels[p][c]), y = double(b[i].pixels[p][c]);
                    difference = std::max(difference, std::abs(x - y));
                    greatest = std::max({greatest, std::abs(x), std::abs(y)});
                }
                differing += difference > tolerance * greatest;
                ++count;
            }
        return differing / count;
    }
};

// A pixel differs by more than a float's error only where rounding decides: a vertex at the border of a merge, a shadow's
// edge, a light drawn by a number at the end of its share. Not so vcm: its connections draw from light vertices in the
// order of their cells, and one that rounding puts into another cell renumbers those between.
TEST_F(PrecisionTest, FloatAndDoubleFollowTheSamePaths) {
    for (const char* technique : {"pt", "lt", "bpt", "bpm"}) {
        SCOPED_TRACE(technique);
        expectWithin({"Accumulation", std::string(technique) + ", paths of three edges: a float's error against a double's",
                      "share of pixels that differ by more than 1e-3", 0.02},
                     differingShare(render(technique, Precision::Float), render(technique, Precision::Double), 1e-3),
                     deviceName());
    }
}

TEST_F(PrecisionTest, AnotherSeedDiffersEverywhere) {
    EXPECT_GT(differingShare(render("bpm", Precision::Float), render("bpm", Precision::Double, 2), 1e-3), 0.9);
}

TEST_F(PrecisionTest, DoubleRendersTheSameBytesAgain) {
    EXPECT_EQ(differingShare(render("vcm", Precision::Double), render("vcm", Precision::Double), 0), 0);
}

}  // namespace
}  // namespace antipode::test
