// What the blur layer sums, against renders with two radii, and the bias that is told from it, against closed forms: a
// floor under a point light, of which merging takes the mean over a disk.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderengine/error_classes.h"
#include "renderengine/error_estimate.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

constexpr uint32_t side = 24;
constexpr double halfWidth = 1.5, radius = 0.3;

/// Of radiance 1 below the light.
Scene floorUnderALight() {
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 20, addLambert(scene, Vec3f(0.5f)));
    addPointLight(scene, {0, 0, 1}, Vec3f(float(2 * std::numbers::pi)));
    scene.camera = lookDownOn(0, 0, 10, halfWidth);
    return scene;
}

double radianceAt(double x, double y) { return std::pow(1 + x * x + y * y, -1.5); }

double meanOverDisk(double x, double y, double r) {
    constexpr int rings = 16, spokes = 32;
    double sum = 0;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < spokes; ++j) {
            const double distance = r * std::sqrt((i + 0.5) / rings), angle = 2 * std::numbers::pi * (j + 0.5) / spokes;
            sum += radianceAt(x + distance * std::cos(angle), y + distance * std::sin(angle));
        }
    return sum / (rings * spokes);
}

/// √relMSE in percent of what `biasAt` gives at the middles of the pixels.
template <class BiasAt>
double norm(const BiasAt& biasAt) {
    double sum = 0;
    for (uint32_t p = 0; p < side * side; ++p) {
        const double x = halfWidth * (2 * (p % side + 0.5) / side - 1),
                     y = halfWidth * (2 * (p / side + 0.5) / side - 1);
        const double reference = radianceAt(x, y);
        sum += biasAt(x, y) * biasAt(x, y) / (reference * reference + relativeErrorEpsilon);
    }
    return 100 * std::sqrt(sum / (side * side));
}

/// Nothing but a merge finds the light: it weighs 1 at any radius.
RenderSettings merging() {
    RenderSettings settings;
    settings.width = settings.height = side;
    settings.technique = "ppm";
    settings.initialRadius = radius;
    settings.alpha = 1;
    settings.lightPathCount = 8000;
    settings.maxPathLength = 2;
    settings.layers.add(LayerKind::Blur);
    return settings;
}

class MergeBiasTest : public EngineTest {};

}  // namespace

TEST_F(MergeBiasTest, BlurIsTheDifferenceOfTwoRadii) {
    const Scene scene = floorUnderALight();
    for (const auto& [technique, precision] :
         {std::pair("ppm", Precision::Float), std::pair("bpm", Precision::Double)}) {
        SCOPED_TRACE(std::string(technique) + " in " + name(precision));
        RenderSettings settings = merging();
        settings.technique = technique;
        settings.precision = precision;
        const FilmSums both = renderSums(scene, settings, {1});
        settings.layers = {};
        settings.initialRadius = radius / std::numbers::sqrt2;
        const Image whole = both.image(), inner = renderSums(scene, settings, {1}).image();
        const size_t blur = both.layout.find(LayerKind::Blur);
        const double unit = std::ldexp(1, -both.layout.layers[blur].scaleExponent);
        double greatest = 0;
        for (size_t p = 0; p < whole.pixels.size(); ++p) {
            const double expected = double(whole.pixels[p].x) - double(inner.pixels[p].x);
            EXPECT_NEAR(double(both.layer(blur)[p]) * unit, expected, 1.01 * unit) << p;
            greatest = std::max(greatest, std::abs(expected));
        }
        EXPECT_GT(greatest, 100 * unit);
    }
}

// Null hypothesis: the interval of 16 iterations holds the bias, that of smooth light, with probability 0.95 at least.
// Rejected where it misses in 5 of 12 renders and more (probability 2·10^-4; binomial, exact): iterations 1 to 192,
// which have one radius and independent numbers, one set of 16 after the other. All of them together tell what the two
// radii differ by, and that is half of the bias.
TEST_F(MergeBiasTest, TheBiasIsTold) {
    const double blur = norm([](double x, double y) {
        return meanOverDisk(x, y, radius) - meanOverDisk(x, y, radius / std::numbers::sqrt2);
    });
    const double bias = norm([](double x, double y) { return meanOverDisk(x, y, radius) - radianceAt(x, y); });
    EXPECT_NEAR(2 * blur / bias, 1, 0.06) << "the fourth derivatives";
    RenderSettings settings = merging();
    settings.sampler = Sampler::Independent;
    Engine engine(floorUnderALight(), settings);
    int misses = 0;
    FilmSums all;
    for (uint64_t set = 0; set < 12; ++set) {
        FilmSums sums;
        for (uint64_t i = 0; i < 16; ++i) {
            engine.reset();
            engine.render(16 * set + i + 1);
            if (i == 0)
                sums = inErrorClasses(engine.sums(), 0);
            else
                sums.merge(engine.sums(), errorClass(i));
        }
        const MergeBias found = estimateError(sums).value().bias.value();
        misses += bias < found.low || bias > found.high;
        if (set == 0)
            all = sums;
        else
            all.merge(sums);
    }
    expectHealthy(engine);
    RecordProperty("misses", misses);
    EXPECT_LE(misses, 4);
    const ErrorEstimate together = estimateError(all).value();
    RecordProperty("told", std::to_string(together.bias->percent));
    EXPECT_TRUE(together.bias->told());
    EXPECT_NEAR(together.bias->percent / (2 * std::numbers::sqrt2 * blur), 1, 0.1);
    EXPECT_LT(together.bias->low, bias);
    EXPECT_GT(together.bias->high, bias);
    EXPECT_GT(together.percent, together.noisePercent);
}

}  // namespace antipode::test
