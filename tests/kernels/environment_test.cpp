// Environment maps in lib/light.glsl: densities, frequencies and the direction that each texel has. Null hypothesis of
// each χ²: texels are drawn with the probability that the density gives their solid angle. Significance 0.01 (Šidák);
// seeds fixed.
#include <cmath>
#include <numbers>

#include "support/hard_case.h"
#include "support/statistics.h"
#include "tests/kernels/light_bench.h"

namespace antipode {
namespace {

constexpr double pi = std::numbers::pi;

struct EnvironmentCase {
    uint32_t width, height;
    float rotation;
    bool zUp;
};

constexpr EnvironmentCase cases[] = {{16, 8, 0, false}, {16, 8, 0.7f, false}, {16, 8, -2.0f, true},
                                     {1, 1, 0, false},  {7, 5, 4, true},      {1024, 512, 1, false}};
const double significance = sidak(0.01, 2 * std::size(cases));

/// A tenth of the texels are black, the others span four decades, one is a sun.
Scene mapScene(const EnvironmentCase& c) {
    Scene scene = darkScene();
    Environment& e = scene.environment.emplace();
    e.radiance = {1, 0.5f, 2};
    e.width = c.width, e.height = c.height;
    e.rotation = c.rotation;
    e.zUp = c.zUp;
    Random random(c.width);
    for (uint32_t i = 0; i < c.width * c.height; ++i)
        e.map.push_back(
            Vec3f(float(c.width > 1 && random.uniform() < 0.1 ? 0 : std::pow(10.0, random.uniform(-4, 0)))));
    e.map[e.map.size() / 3] = Vec3f(c.width > 100 ? 1e4f : 10.0f);
    return scene;
}

/// Column and row, as reals, of the map where `d` points: the convention of renderengine/scene.h.
std::array<double, 2> mapPosition(const Environment& e, const Vec3d& d) {
    // With the map's up axis +Z, its −Z (φ = 0) becomes +Y.
    const Vec3d up = e.zUp ? Vec3d{d.x, d.z, -d.y} : d;
    const double u = std::atan2(up.x, -up.z) / (2 * pi) + 0.5 - double(e.rotation) / (2 * pi);
    return {(u - std::floor(u)) * e.width, std::acos(std::clamp(up.y / length(up), -1.0, 1.0)) / pi * e.height};
}

double rowSolidAngle(const Environment& e, uint32_t row) {
    return 2 * pi / e.width * (std::cos(pi * row / e.height) - std::cos(pi * (row + 1) / e.height));
}

class EnvironmentTest : public DeviceTest {};

TEST_F(EnvironmentTest, FrequenciesFollowTheDensity) {
    Random random(1);
    for (const EnvironmentCase& c : cases) {
        SCOPED_TRACE(testing::Message() << c.width << " × " << c.height << ", rotation " << c.rotation
                                        << (c.zUp ? ", z up" : ""));
        const Scene scene = mapScene(c);
        const Environment& e = *scene.environment;
        LightBench bench(*device, scene);
        constexpr size_t draws = 400000;
        const auto drawn = bench.environment(draws, random);
        // Texels one by one where there are few, blocks of 16 × 16 where there are many.
        const uint32_t block = c.width > 100 ? 16 : 1, columns = (c.width + block - 1) / block,
                       rows = (c.height + block - 1) / block;
        std::vector<double> expected(columns * rows), observed(columns * rows);
        double integral = 0;
        for (uint32_t y = 0; y < c.height; ++y)
            for (uint32_t x = 0; x < c.width; ++x) {
                const double share =
                    double(bench.packed().environmentMap[size_t(y) * c.width + x].w) * rowSolidAngle(e, y);
                integral += share;
                expected[(y / block) * columns + x / block] += share * double(draws);
            }
        EXPECT_NEAR(integral, 1, 1e-5);
        size_t elsewhere = 0, wrongValue = 0;
        Moments inside;
        for (const DrawnEnvironment& d : drawn) {
            const auto [x, y] = mapPosition(e, d.direction);
            const auto column = std::min(uint32_t(x), c.width - 1), row = std::min(uint32_t(y), c.height - 1);
            ++observed[(row / block) * columns + column / block];
            inside.add(x - std::floor(x));
            // Near a texel's border the kernels may see its neighbour: their arcus tangens is good to 4e-6.
            const auto nearBorder = [](double v, uint32_t count) {
                return std::abs(v - std::round(v)) < 2e-6 * count + 1e-4;
            };
            if (nearBorder(x, c.width) || nearBorder(y, c.height)) {
                ++elsewhere;
                continue;
            }
            const size_t texel = size_t(row) * c.width + column;
            wrongValue += std::abs(d.pdf - double(bench.packed().environmentMap[texel].w)) > 1e-6 * d.pdf;
            wrongValue += std::abs(d.radiance.x - double(e.map[texel].x)) > 1e-6 * d.radiance.x ||
                          std::abs(d.radiance.z - 2 * d.radiance.x) > 1e-5 * d.radiance.x;
        }
        EXPECT_EQ(wrongValue, 0u) << "densities or radiances of another texel";
        EXPECT_LE(elsewhere, draws / 20);
        if (observed.size() > 1) {
            // Rounding carries one draw in 10⁴ over a border, which black texels must not be blamed for.
            double total = 0;
            for (double& x : expected) total += x += 1e-4 * double(draws) / double(expected.size());
            for (double& x : expected) x *= double(draws) / total;
            expectWithin({"Sampling", "environment maps to 1024 × 512 texels over eight decades, a tenth black",
                          "largest −log₁₀ p of χ² tests", -std::log10(significance)},
                         -std::log10(chiSquareTest(observed, expected).pValue), device->info().name);
        }
        // Draws are spread over a texel's whole width.
        EXPECT_NEAR(inside.mean(), 0.5, 0.003);
        EXPECT_NEAR(inside.variance(), 1.0 / 12, 0.001);
    }
}

// The last rows of a tall map: the cosine of their angle to the pole rounds to 1. Null hypothesis: draws are uniform in
// solid angle over the row that is lit; significance 0.01 (Šidák). None lies outside it by more than the float rounding
// of the direction: 2^-22 of its sine, twice that of the haversine.
TEST_F(EnvironmentTest, PolesOfTallMaps) {
    constexpr uint32_t height = 8192;
    constexpr int bins = 16;
    const uint32_t rows[] = {0, 1, 5, height - 3, height - 1};
    Random random(7);
    for (uint32_t row : rows) {
        SCOPED_TRACE(row);
        Scene scene = darkScene();
        Environment& e = scene.environment.emplace();
        e.radiance = {1, 1, 1};
        e.width = 2, e.height = height;
        e.map.resize(size_t(e.width) * e.height);
        e.map[size_t(2) * row] = e.map[size_t(2) * row + 1] = Vec3f(1);
        constexpr size_t draws = 100000;
        std::vector<double> observed(bins), expected(bins, double(draws) / bins);
        const bool south = row >= height / 2;
        const auto haversine = [&](double r) { return std::pow(std::sin(0.5 * pi * r / height), 2); };
        const double fromPole = south ? height - 1 - row : row;
        const double low = haversine(fromPole), high = haversine(fromPole + 1);
        const double rounding = 0x1p-21 * high;
        size_t outside = 0, elsewhere = 0;
        for (const DrawnEnvironment& d : LightBench(*device, scene).environment(draws, random)) {
            // From the sine: exact near the pole.
            const double sine2 =
                double(d.direction.x) * double(d.direction.x) + double(d.direction.z) * double(d.direction.z);
            const double h = 0.5 * (1 - std::sqrt(1 - sine2));
            outside += (d.direction.y > 0) == south;
            elsewhere += h < low - rounding || h > high + rounding;
            const double at = std::clamp((h - low) / (high - low), 0.0, 1 - 1e-9);
            ++observed[size_t(at * bins)];
        }
        EXPECT_EQ(outside, 0u);
        EXPECT_EQ(elsewhere, 0u) << "outside the lit row";
        expectWithin({"Sampling", "first and last rows of an environment map 8192 rows tall",
                      "largest −log₁₀ p of χ² tests", -std::log10(sidak(0.01, std::size(rows)))},
                     -std::log10(chiSquareTest(observed, expected).pValue), device->info().name);
    }
}

TEST_F(EnvironmentTest, EveryTexelLiesWhereTheSceneSays) {
    for (const EnvironmentCase& c : cases) {
        if (c.width > 100) continue;
        SCOPED_TRACE(testing::Message() << c.width << " × " << c.height << ", rotation " << c.rotation
                                        << (c.zUp ? ", z up" : ""));
        const Scene scene = mapScene(c);
        const Environment& e = *scene.environment;
        LightBench bench(*device, scene);
        std::vector<Vec3d> directions;
        for (uint32_t y = 0; y < c.height; ++y)
            for (uint32_t x = 0; x < c.width; ++x) {
                const double phi = 2 * pi * ((x + 0.5) / c.width + double(e.rotation) / (2 * pi) - 0.5),
                             theta = pi * (y + 0.5) / c.height;
                const Vec3d d{std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta)};
                directions.push_back(e.zUp ? Vec3d{d.x, -d.z, d.y} : d);
            }
        const auto values = bench.evalEnvironment(directions);
        for (size_t i = 0; i < values.size(); ++i)
            EXPECT_NEAR(values[i].radiance.x, double(e.map[i].x), 1e-6 * double(e.map[i].x)) << i;
    }
}

}  // namespace
}  // namespace antipode
