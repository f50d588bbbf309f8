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

    /// Of the pixels that are not black in both, half differ by no more than this part of their greatest channel.
    static double medianDifference(const std::vector<Image>& a, const std::vector<Image>& b) {
        std::vector<double> differences;
        for (size_t i = 0; i < a.size(); ++i)
            for (size_t p = 0; p < a[i].pixels.size(); ++p) {
                double difference = 0, greatest = 0;
                for (int c = 0; c < 3; ++c) {
                    const double x = double(a[i].pixels[p][c]), y = double(b[i].pixels[p][c]);
                    difference = std::max(difference, std::abs(x - y));
                    greatest = std::max({greatest, std::abs(x), std::abs(y)});
                }
                if (greatest > 0) differences.push_back(difference / greatest);
            }
        if (differences.empty()) return 1;
        const auto middle = differences.begin() + std::ptrdiff_t(differences.size() / 2);
        std::nth_element(differences.begin(), middle, differences.end());
        return *middle;
    }
};

// A pixel differs by more than the roundings of its own path only where one decides: a vertex at the border of a merge,
// a shadow's edge, a light drawn by a number at the end of its share. Not so vcm: its connections draw from light
// vertices in the order of their cells, and one that rounding puts into another cell renumbers those between. The
// bound: a hundred roundings, on three edges.
TEST_F(PrecisionTest, FloatAndDoubleFollowTheSamePaths) {
    for (const char* technique : {"pt", "lt", "bpt", "bpm"}) {
        SCOPED_TRACE(technique);
        expectWithin({"Precision", std::string(technique) + " in float beside double, paths of three edges",
                      "median relative difference of pixels", 100 * 0x1p-24},
                     medianDifference(render(technique, Precision::Float), render(technique, Precision::Double)),
                     deviceName());
    }
}

TEST_F(PrecisionTest, AnotherSeedDiffersEverywhere) {
    EXPECT_GT(medianDifference(render("bpm", Precision::Float), render("bpm", Precision::Double, 2)), 0.01);
}

TEST_F(PrecisionTest, DoubleRendersTheSameBytesAgain) {
    const auto once = render("vcm", Precision::Double), again = render("vcm", Precision::Double);
    for (size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].pixels, again[i].pixels);
}

}  // namespace
}  // namespace antipode::test
