// lib/light.glsl: where light paths start, what next-event samples estimate. Null hypotheses: positions and directions
// follow the densities (χ² on 16 × 16 cells of equal probability); means are closed forms (t-tests). Significance 0.01
// over all tests of this file (Šidák, 60 tests); seeds fixed.
#include <cmath>
#include <numbers>

#include "support/closed_forms.h"
#include "support/hard_case.h"
#include "support/reference/geometry.h"
#include "support/statistics.h"
#include "tests/kernels/light_bench.h"

namespace antipode {
namespace {

constexpr double pi = std::numbers::pi;
constexpr size_t samples = 100000;
const double significance = sidak(0.01, 60);

/// χ² of points of the unit square against the uniform distribution.
class SquareTest {
public:
    void add(double u, double v) {
        const auto at = [](double x) { return size_t(std::clamp(int(x * 16), 0, 15)); };
        ++observed_[at(u) * 16 + at(v)];
        ++count_;
    }
    double pValue() const { return chiSquareTest(observed_, std::vector<double>(256, double(count_) / 256)).pValue; }

private:
    std::vector<double> observed_ = std::vector<double>(256);
    size_t count_ = 0;
};

double turn(double y, double x) {
    const double t = std::atan2(y, x) / (2 * pi);
    return t < 0 ? t + 1 : t;
}

/// Unit-square coordinates under which each density is uniform.
void addUniformDirection(SquareTest& test, const Vec3d& d) { test.add((d.z + 1) / 2, turn(d.y, d.x)); }
void addCosineDirection(SquareTest& test, const Vec3d& d, const Vec3d& normal) {
    const Vec3d local = reference::Frame(normal).toLocal(d);
    test.add(local.z * local.z, turn(local.y, local.x));
}
void addConeDirection(SquareTest& test, const Vec3d& d, const Vec3d& axis, double versineOuter) {
    const Vec3d local = reference::Frame(axis).toLocal(d);
    const double sine2 = local.x * local.x + local.y * local.y;
    const double versine = local.z > 0 ? sine2 / (1 + std::sqrt(1 - sine2)) : 1 - local.z;
    test.add(versine / versineOuter, turn(local.y, local.x));
}
/// Origins on the disk that faces the scene from `direction`'s upstream.
void addDisk(SquareTest& test, const DrawnEmission& e, const LightBench& bench) {
    const Vec3d local =
        reference::Frame(normalize(e.direction)).toLocal(e.origin - bench.sceneCenter()) / bench.sceneRadius();
    ASSERT_NEAR(local.z, -1, 1e-5);
    test.add(local.x * local.x + local.y * local.y, turn(local.y, local.x));
}

class LightTest : public DeviceTest {
protected:
    void expectMeasured(const std::string& quantity, double bound, double measured) {
        expectWithin({"Lights", difficulty, quantity, bound}, measured, device->info().name);
    }
    void expectNull(const std::string& tests, double pValue) {
        expectMeasured("largest −log₁₀ p of " + tests, -std::log10(significance), -std::log10(pValue));
    }

    std::string difficulty;

    /// E[throughput] is the emitted power; for infinite lights that through the disk of the scene's radius.
    void expectPower(const std::vector<DrawnEmission>& drawn, double power) {
        Moments m;
        for (const DrawnEmission& e : drawn) {
            ASSERT_TRUE(isFinite(e.throughput) && std::isfinite(e.dVCM) && std::isfinite(e.dVC));
            m.add(e.valid ? e.throughput.x : 0);
        }
        expectMean(m, power);
    }

    /// Estimators without variance are held to float accuracy.
    void expectMean(const Moments& m, double expected) {
        SCOPED_TRACE(testing::Message() << m.mean() << " for " << expected);
        if (std::sqrt(m.variance()) < 1e-5 * expected)
            expectMeasured("relative error of means without variance", 1e-5, std::abs(m.mean() / expected - 1));
        else
            expectNull("t-tests of powers and irradiances", tTest(m, expected).pValue);
    }

    /// E[value·cos] on a plane facing up, and E[1/pdf], the solid angle that the light spans.
    void expectDirect(LightBench& bench, const Vec3f& position, double irradiance, std::optional<double> solidAngle,
                      Random& random) {
        Moments received, angle;
        for (const DrawnDirect& d : bench.direct(position, samples, random)) {
            const Vec3d toTarget = d.target - Vec3d(position);
            if (d.valid) {
                ASSERT_TRUE(d.pdf > 0 && std::isfinite(d.pdf) && d.emitRatio >= 0 && std::isfinite(d.emitRatio));
                ASSERT_NEAR(length(d.direction), 1, 1e-6);
                ASSERT_LE(length(normalize(toTarget) - d.direction), 1e-4) << "the segment does not end at the light";
            }
            received.add(d.valid ? d.value.x * std::max(d.direction.z, 0.0) : 0);
            angle.add(d.valid ? 1 / d.pdf : 0);
        }
        expectMean(received, irradiance);
        if (solidAngle) expectMean(angle, *solidAngle);
    }
};

/// A rectangle 2a × 2b at height h that shines down, as two triangles.
void addRectangle(Scene& scene, float a, float b, float h, float radiance, bool bothSides) {
    Material m;
    m.emission = Vec3f(radiance);
    m.emitsBothSides = bothSides;
    Mesh mesh;
    mesh.material = uint32_t(scene.materials.size());
    mesh.positions = {{-a, -b, h}, {a, -b, h}, {a, b, h}, {-a, b, h}};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    scene.materials.push_back(m);
    scene.meshes.push_back(mesh);
}

/// Solid angle of a rectangle 2a × 2b from below its centre.
double rectangleSolidAngle(double a, double b, double h) {
    return 4 * std::asin(a * b / std::sqrt((a * a + h * h) * (b * b + h * h)));
}

TEST_F(LightTest, Rectangle) {
    difficulty = "a rectangle of one or two glowing sides, under its centre and its corner";
    Random random(1);
    for (const bool both : {false, true}) {
        SCOPED_TRACE(both ? "both sides" : "front");
        Scene scene = darkScene();
        addRectangle(scene, 1.5f, 0.5f, 2, 3, both);
        LightBench bench(*device, scene);
        const auto drawn = bench.emission(samples, random);
        expectPower(drawn, 3 * pi * 3 * (both ? 2 : 1));
        SquareTest positions, directions;
        double below = 0;
        for (const DrawnEmission& e : drawn) {
            ASSERT_NEAR(e.origin.z, 2, 1e-5);
            positions.add((e.origin.x + 1.5) / 3, e.origin.y + 0.5);
            addCosineDirection(directions, e.direction, {0, 0, e.direction.z > 0 ? 1.0 : -1.0});
            below += e.direction.z < 0;
            // P_direct/P_emit and cosine/P_emit; the lights' areas are equal, so q/A is 1/6 on each triangle.
            const double emit = std::abs(e.direction.z) / pi * (both ? 0.5 : 1) / 3;
            ASSERT_NEAR(e.dVC, std::abs(e.direction.z) / emit, 1e-3 * e.dVC);
            ASSERT_NEAR(e.dVCM, 1.0 / 3 / emit, 1e-3 * e.dVCM);
        }
        expectNull("χ² tests of positions", positions.pValue());
        expectNull("χ² tests of directions", directions.pValue());
        if (both)
            expectNull("z-tests of sides", normalTwoSidedP((2 * below - double(samples)) / std::sqrt(double(samples))));
        else
            EXPECT_EQ(below, double(samples));

        expectDirect(bench, {0, 0, 0}, 3 * pi * closed_forms::formFactorUnderCentre(3, 1, 2),
                     rectangleSolidAngle(1.5, 0.5, 2), random);
        expectDirect(bench, {1.5f, 0.5f, 0}, 3 * pi * closed_forms::formFactorUnderCorner(3, 1, 2), {}, random);
    }
}

TEST_F(LightTest, Sphere) {
    difficulty = "a sphere, sampled by what is seen of it";
    Random random(2);
    Scene scene = darkScene();
    Material m;
    m.emission = Vec3f(2.0f);
    scene.materials.push_back(m);
    scene.spheres.push_back({{0.5f, 0, 3}, 0.7f, 1});
    LightBench bench(*device, scene);
    const double radius = double(0.7f);
    const auto drawn = bench.emission(samples, random);
    expectPower(drawn, 2 * pi * 4 * pi * radius * radius);
    SquareTest positions, directions;
    for (const DrawnEmission& e : drawn) {
        const Vec3d n = (e.origin - Vec3d{0.5, 0, 3}) / radius;
        ASSERT_NEAR(length(n), 1, 1e-5);
        addUniformDirection(positions, n);
        addCosineDirection(directions, e.direction, normalize(n));
    }
    expectNull("χ² tests of positions", positions.pValue());
    expectNull("χ² tests of directions", directions.pValue());
    const double sine = radius / 3;
    expectDirect(bench, {0.5f, 0, 0}, closed_forms::irradianceOfSphereLight(2, radius, 3, 0),
                 2 * pi * (1 - std::sqrt(1 - sine * sine)), random);
    expectDirect(bench, {2.5f, 0, 0}, closed_forms::irradianceOfSphereLight(2, radius, 3, 2), {}, random);
}

TEST_F(LightTest, Point) {
    difficulty = "a position without extent";
    Random random(3);
    Scene scene = darkScene();
    scene.pointLights.push_back({{1, 2, 3}, Vec3f(5.0f)});
    LightBench bench(*device, scene);
    const auto drawn = bench.emission(samples, random);
    expectPower(drawn, 4 * pi * 5);
    SquareTest directions;
    for (const DrawnEmission& e : drawn) {
        ASSERT_EQ(e.origin, (Vec3d{1, 2, 3}));
        ASSERT_EQ(e.dVC, 0);
        ASSERT_NEAR(e.dVCM, 4 * pi, 1e-5);
        addUniformDirection(directions, e.direction);
    }
    expectNull("χ² tests of directions", directions.pValue());
    expectDirect(bench, {1, 2, 0}, closed_forms::irradianceOfPointLight(5, 3, 0), {}, random);
    expectDirect(bench, {1, 0, 0}, closed_forms::irradianceOfPointLight(5, 3, 2), {}, random);
}

TEST_F(LightTest, Spot) {
    difficulty = "cones from 1e-4 to 1.2 rad, also without falloff";
    Random random(4);
    for (const auto& [inner, outer] :
         {std::pair{0.2f, 0.6f}, {0.0f, 1.2f}, {0.4f, 0.4f}, {0.01f, 0.02f}, {5e-4f, 1e-3f}, {0.0f, 1e-4f}}) {
        SCOPED_TRACE(testing::Message() << inner << " to " << outer);
        Scene scene = darkScene();
        const Vec3f axis = normalize(Vec3f{0.3f, 0.2f, -0.9f});
        scene.spotLights.push_back({{0, 0, 3}, axis, Vec3f(7.0f), inner, outer});
        LightBench bench(*device, scene);
        const auto versine = [](double angle) { return 2 * std::pow(std::sin(angle / 2), 2); };
        const double vi = versine(double(inner)), vo = versine(double(outer));
        const auto drawn = bench.emission(samples, random);
        // ∫ t² from cos outer to cos inner is a third; inside it is 1.
        expectPower(drawn, 7 * 2 * pi * (vi + (vo - vi) / 3));
        SquareTest directions;
        for (const DrawnEmission& e : drawn)
            addConeDirection(directions, e.direction, normalize(Vec3d(axis)), double(float(vo)));
        expectNull("χ² tests of directions", directions.pValue());
        // On the axis, on a plane facing up.
        const Vec3d on = Vec3d{0, 0, 3} + normalize(Vec3d(axis)) * 2.0;
        expectDirect(bench, Vec3f(on), 7.0 / 4 * -normalize(Vec3d(axis)).z, {}, random);
    }
}

TEST_F(LightTest, Directional) {
    difficulty = "a direction without extent, infinitely far";
    Random random(5);
    Scene scene = darkScene();
    const Vec3f direction = normalize(Vec3f{1, 2, -4});
    scene.directionalLights.push_back({direction, Vec3f(6.0f)});
    LightBench bench(*device, scene);
    const auto drawn = bench.emission(samples, random);
    expectPower(drawn, 6 * pi * bench.sceneRadius() * bench.sceneRadius());
    SquareTest disk;
    for (const DrawnEmission& e : drawn) {
        ASSERT_EQ(e.direction, Vec3d(direction));
        ASSERT_TRUE(e.infinite);
        ASSERT_EQ(e.dVC, 0);
        addDisk(disk, e, bench);
    }
    expectNull("χ² tests of positions", disk.pValue());
    expectDirect(bench, {0, 0, 0}, 6 * -double(direction.z), {}, random);
}

TEST_F(LightTest, ConstantEnvironment) {
    difficulty = "light from everywhere";
    Random random(6);
    Scene scene = darkScene();
    scene.environment.emplace().radiance = Vec3f(0.5f);
    LightBench bench(*device, scene);
    const double disk = pi * bench.sceneRadius() * bench.sceneRadius();
    const auto drawn = bench.emission(samples, random);
    expectPower(drawn, 0.5 * 4 * pi * disk);
    SquareTest directions, positions;
    for (const DrawnEmission& e : drawn) {
        addUniformDirection(directions, e.direction);
        addDisk(positions, e, bench);
        ASSERT_NEAR(e.dVCM, disk, 1e-4 * disk);
        ASSERT_NEAR(e.dVC, 4 * pi * disk, 1e-4 * e.dVC);
    }
    expectNull("χ² tests of directions", directions.pValue());
    expectNull("χ² tests of positions", positions.pValue());
    expectDirect(bench, {0, 0, 0}, 0.5 * pi, 4 * pi, random);
}

// Several kinds at once: the pick's probability is part of every estimate.
TEST_F(LightTest, AllKindsTogether) {
    difficulty = "lights of all kinds at once";
    Random random(7);
    Scene scene = darkScene();
    addRectangle(scene, 1, 1, 2, 3, false);
    scene.pointLights.push_back({{0, 0, 3}, Vec3f(5.0f)});
    scene.directionalLights.push_back({{0, 0, -1}, Vec3f(1.0f)});
    scene.environment.emplace().radiance = Vec3f(0.05f);
    LightBench bench(*device, scene);
    const double disk = pi * bench.sceneRadius() * bench.sceneRadius();
    expectPower(bench.emission(samples, random), 3 * pi * 4 + 4 * pi * 5 + disk + 0.05 * 4 * pi * disk);
    expectDirect(bench, {0, 0, 0}, 3 * pi * closed_forms::formFactorUnderCentre(2, 2, 2) + 5.0 / 9 + 1 + 0.05 * pi, {},
                 random);
}

TEST_F(LightTest, TenThousandEmittersArePickedByPower) {
    difficulty = "10⁴ emitters whose powers differ by six decades, a tenth without any";
    Random random(8);
    Scene scene = darkScene();
    std::vector<double> powers;
    double total = 0;
    for (int i = 0; i < 10000; ++i) {
        // A tenth shine nothing, the others over six decades.
        const auto intensity = float(i % 10 == 0 ? 0 : std::pow(10.0, random.uniform(-6, 0)));
        scene.pointLights.push_back({{0, 0, 1}, Vec3f(intensity)});
        powers.push_back(double(intensity));
        total += double(intensity);
    }
    LightBench bench(*device, scene);
    ASSERT_EQ(bench.packed().lightCount, powers.size());
    constexpr size_t draws = 2000000;
    std::vector<double> observed(powers.size()), expected;
    for (double p : powers) expected.push_back(p / total * double(draws));
    size_t wrongProbability = 0;
    for (const auto& [light, q] : bench.picks(draws, random)) {
        ++observed.at(light);
        wrongProbability += std::abs(q - powers[light] / total) > 1e-6 * q;
    }
    expectMeasured("picks whose probability errs by more than 10⁻⁶", 0, double(wrongProbability));
    expectNull("χ² tests of picks", chiSquareTest(observed, expected).pValue);
    // The faint half together: each of them is too rare to be counted alone, and a coarse fraction would favour them.
    double faintDrawn = 0, faint = 0;
    for (size_t i = 0; i < powers.size(); ++i)
        if (powers[i] < 1e-3) faintDrawn += observed[i], faint += expected[i];
    SCOPED_TRACE(testing::Message() << faintDrawn << " for " << faint);
    expectNull("z-tests of the faint half", normalTwoSidedP((faintDrawn - faint) / std::sqrt(faint)));
}

}  // namespace
}  // namespace antipode
