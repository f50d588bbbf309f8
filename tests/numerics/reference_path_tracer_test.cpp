// The reference path tracer against closed forms, and its two estimators against each other.
// Every t-test: null hypothesis "the mean is the closed form", α = .01 over the tests of its case, fixed seeds.
#include "support/reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderengine/error.h"
#include "support/closed_forms.h"

namespace antipode::reference {
namespace {

uint32_t addMaterial(Scene& scene, MaterialKind kind, float baseColor, float emission = 0) {
    Material m;
    m.kind = kind;
    m.baseColor = Vec3f(baseColor);
    m.specular = Vec3f(baseColor);
    m.emission = Vec3f(emission);
    scene.materials.push_back(m);
    return uint32_t(scene.materials.size() - 1);
}

/// A rectangle about `center`; its front is on the side of u × v.
void addQuad(Scene& scene, Vec3f center, Vec3f u, Vec3f v, uint32_t material) {
    Mesh mesh;
    mesh.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    scene.meshes.push_back(mesh);
}

/// A floor at z = 0 that reflects ρ, 100 wide.
Scene floorScene(float reflectance) {
    Scene scene;
    addQuad(scene, {0, 0, 0}, {50, 0, 0}, {0, 50, 0}, addMaterial(scene, MaterialKind::Lambert, reflectance));
    return scene;
}

/// A ray that meets the floor at (x, 0, 0) from a slant, from below any light.
Ray rayToFloor(double x) { return {{x, 0.2, 0.1}, normalize(Vec3d{0, -2, -1})}; }

constexpr PathTracerOptions kNaive{.nextEvent = false};

PathTracerOptions bounded(bool nextEvent, uint32_t maxPathLength) {
    return {.nextEvent = nextEvent, .maxPathLength = maxPathLength, .russianRoulette = false};
}

void expectMean(const RadianceMoments& moments, double expected, uint64_t tests) {
    EXPECT_GT(tTest(moments.r, expected).pValue, bonferroni(0.01, tests))
        << "mean " << moments.r.mean() << " ± " << std::sqrt(moments.r.meanVariance()) << ", expected " << expected;
}

// --- Furnaces ---

TEST(ReferencePathTracer, WhiteFurnace) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addMaterial(scene, MaterialKind::Lambert, 0.8f)});
    scene.environment = Environment{.radiance = Vec3f(1.0f), .map = {}};
    const PathTracer tracer(scene);
    const Ray ray{{0.4, 0.3, 3}, {0, 0, -1}};
    const double expected = closed_forms::whiteFurnace(double(0.8f), 1);
    expectMean(tracer.radianceMoments(ray, {}, 20000, 41), expected, 2);
    expectMean(tracer.radianceMoments(ray, kNaive, 20000, 42), expected, 2);
}

TEST(ReferencePathTracer, LosslessGlassIsInvisibleInAFurnaceAndBrighterInside) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addMaterial(scene, MaterialKind::Dielectric, 1)});
    scene.environment = Environment{.radiance = Vec3f(1.0f), .map = {}};
    const PathTracer tracer(scene);
    Random random(43);
    for (int i = 0; i < 1000; ++i) {
        const Ray outside{{random.uniform(-0.99, 0.99), 0, 3}, {0, 0, -1}};
        EXPECT_NEAR(tracer.radiance(outside, bounded(true, 1000), random).x, 1, 1e-12);
        const double expected = closed_forms::radianceInsideGlass(1.5, 1);
        EXPECT_NEAR(tracer.radiance({{0, 0, 0}, {0, 0, 1}}, bounded(true, 1000), random).x, expected, 1e-12);
    }
}

TEST(ReferencePathTracer, ClosedFurnaceBounceByBounce) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addMaterial(scene, MaterialKind::Lambert, 0.5f, 1)});
    scene.materials[0].emitsBothSides = true;
    const PathTracer tracer(scene);
    const Ray ray{{0.1, 0.2, 0.3}, {0, 0, 1}};
    Random random(44);
    for (uint32_t bounces = 0; bounces < 4; ++bounces) {
        const double expected = closed_forms::closedFurnace(1, 0.5, bounces);
        EXPECT_NEAR(tracer.radiance(ray, bounded(false, bounces + 1), random).x, expected, 1e-12);
        if (bounces > 0) expectMean(tracer.radianceMoments(ray, bounded(true, bounces + 1), 20000, 45), expected, 4);
    }
    expectMean(tracer.radianceMoments(ray, {}, 20000, 46), closed_forms::closedFurnace(1, 0.5), 4);
}

TEST(ReferencePathTracer, MinimumPathLengthLeavesTheOtherTerms) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addMaterial(scene, MaterialKind::Lambert, 0.5f, 1)});
    scene.materials[0].emitsBothSides = true;
    const PathTracer tracer(scene);
    const Ray ray{{0.1, 0.2, 0.3}, {0, 0, 1}};
    for (const bool nextEvent : {false, true}) {
        PathTracerOptions third = bounded(nextEvent, 3);
        third.minPathLength = 3;
        expectMean(tracer.radianceMoments(ray, third, 20000, 47), 0.25, 2);
    }
}

TEST(ReferencePathTracer, FacingMirrors) {
    Scene scene;
    const uint32_t mirror = addMaterial(scene, MaterialKind::Mirror, 0.75f, 2);
    scene.materials[mirror].emitsBothSides = true;
    addQuad(scene, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, mirror);
    addQuad(scene, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, mirror);
    const PathTracer tracer(scene);
    Random random(48);
    for (const uint32_t bounces : {0u, 1u, 10u, 1000u}) {
        const double measured = tracer.radiance({{0.3, 0.1, 0}, {0, 0, 1}}, bounded(true, bounces + 1), random).x;
        EXPECT_NEAR(measured, closed_forms::facingMirrors(2, 0.75, bounces), 1e-11);
    }
}

/// Point light in the centre; the centre itself is as good a viewpoint as any.
TEST(ReferencePathTracer, IntegratingSphere) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 0}, 1, addMaterial(scene, MaterialKind::Lambert, 0.5f)});
    scene.pointLights.push_back({{0, 0, 0}, Vec3f(1.0f)});
    const auto moments = PathTracer(scene).radianceMoments({{0.5, 0, 0}, {0, 0, 1}}, {}, 20000, 49);
    expectMean(moments, closed_forms::integratingSphere(0.5, 1, 1), 1);
}

// --- A floor under one light ---

TEST(ReferencePathTracer, PointLightOverPlane) {
    Scene scene = floorScene(0.5f);
    scene.pointLights.push_back({{0, 0, 2}, Vec3f(100.0f)});
    const PathTracer tracer(scene);
    Random random(50);
    for (const double r : {0.0, 2.0}) {
        const double expected = 0.5 / kPi * closed_forms::irradianceOfPointLight(100, 2, r);
        EXPECT_NEAR(tracer.radiance(rayToFloor(r), {}, random).x, expected, 1e-9);
    }
}

TEST(ReferencePathTracer, SpotAndDirectionalLightOverPlane) {
    Scene scene = floorScene(0.5f);
    scene.spotLights.push_back({{0, 0, 2}, {0, 0, -1}, Vec3f(100.0f), 0.2f, 0.6f});
    Random random(51);
    const PathTracer spot(scene);
    EXPECT_NEAR(spot.radiance(rayToFloor(0), {}, random).x, 0.5 / kPi * 25, 1e-9);
    EXPECT_EQ(spot.radiance(rayToFloor(2), {}, random).x, 0) << "45° is outside the cone";
    const double t =
        (std::cos(std::atan(0.5)) - std::cos(double(0.6f))) / (std::cos(double(0.2f)) - std::cos(double(0.6f)));
    const double expected = 0.5 / kPi * closed_forms::irradianceOfPointLight(100, 2, 1) * t * t;
    EXPECT_NEAR(spot.radiance(rayToFloor(1), {}, random).x, expected, 1e-9);

    scene.spotLights.clear();
    scene.directionalLights.push_back({{0.6f, 0, -0.8f}, Vec3f(3.0f)});
    EXPECT_NEAR(PathTracer(scene).radiance(rayToFloor(0), {}, random).x, 0.5 / kPi * 3 * 0.8, 1e-6);
}

TEST(ReferencePathTracer, SphereLight) {
    Scene scene = floorScene(0.5f);
    scene.spheres.push_back({{0, 0, 3}, 1, addMaterial(scene, MaterialKind::Lambert, 0, 1)});
    const PathTracer tracer(scene);
    for (const double r : {0.0, 4.0}) {
        const double expected = 0.5 / kPi * closed_forms::irradianceOfSphereLight(1, 1, 3, r);
        expectMean(tracer.radianceMoments(rayToFloor(r), bounded(true, 2), 40000, 52), expected, 4);
        expectMean(tracer.radianceMoments(rayToFloor(r), bounded(false, 2), 40000, 53), expected, 4);
    }
}

TEST(ReferencePathTracer, RectangleLight) {
    for (const double height : {1.0, 2.0}) {
        Scene scene = floorScene(0.5f);
        const uint32_t lamp = addMaterial(scene, MaterialKind::Lambert, 0, 1);
        scene.materials[lamp].twoSided = false;
        addQuad(scene, {0, 0, float(height)}, {0, 1, 0}, {1, 0, 0}, lamp);  // faces down
        const PathTracer tracer(scene);
        const double expected = 0.5 * closed_forms::formFactorUnderCentre(2, 2, height);
        expectMean(tracer.radianceMoments(rayToFloor(0), bounded(true, 2), 40000, 54), expected, 5);
        expectMean(tracer.radianceMoments(rayToFloor(0), bounded(false, 2), 40000, 55), expected, 5);
        if (height > 1) continue;
        const Ray underCorner{{1, 1.2, 0.1}, normalize(Vec3d{0, -2, -1})};
        const double corner = 0.5 * closed_forms::formFactorUnderCorner(2, 2, 1);
        expectMean(tracer.radianceMoments(underCorner, bounded(true, 2), 40000, 56), corner, 5);
    }
}

// --- Both estimators on everything at once ---

Scene mixedScene() {
    Scene scene = floorScene(0.6f);
    const uint32_t lamp = addMaterial(scene, MaterialKind::Lambert, 0, 5);
    scene.materials[lamp].twoSided = false;
    addQuad(scene, {0, 0, 4}, {0, 1.5f, 0}, {1.5f, 0, 0}, lamp);
    const MaterialKind kinds[] = {MaterialKind::Phong, MaterialKind::RoughConductor, MaterialKind::RoughDielectric,
                                  MaterialKind::Dielectric, MaterialKind::Mirror};
    for (int i = 0; i < 5; ++i) {
        const uint32_t material = addMaterial(scene, kinds[i], 0.4f);
        scene.materials[material].phongExponent = 10;
        scene.materials[material].roughness = 0.6f;
        scene.spheres.push_back({{1.6f * (i - 2), 0, 0.8f}, 0.7f, material});
    }
    scene.environment = Environment{.radiance = Vec3f(0.3f), .map = {}};
    scene.camera = {.position = {0, -9, 3}, .forward = {0, 0.9578f, -0.2874f}, .up = {0, 0, 1}, .verticalFov = 0.6f};
    return scene;
}

/// Null hypothesis: both estimators have the same expectation in every pixel, per path length. Welch's test on 8 × 4
/// pixels and three ranges of path lengths, α = .01 over all 96 (Bonferroni), seeds 60 … 65.
TEST(ReferencePathTracer, NextEventAndNaiveAgreePerPathLength) {
    const PathTracer tracer(mixedScene());
    const uint32_t ranges[3][2] = {{2, 2}, {3, 3}, {4, 6}};
    for (int range = 0; range < 3; ++range) {
        PathTracerOptions options = bounded(true, ranges[range][1]);
        options.minPathLength = ranges[range][0];
        const auto withNextEvent = tracer.image(8, 4, options, 3000, 60 + 2 * range);
        options.nextEvent = false;
        const auto naive = tracer.image(8, 4, options, 3000, 61 + 2 * range);
        double sums[2] = {0, 0};
        for (size_t i = 0; i < naive.size(); ++i) {
            EXPECT_GT(welchTest(withNextEvent[i].g, naive[i].g).pValue, bonferroni(0.01, 96))
                << "pixel " << i << " range " << range << ": " << withNextEvent[i].g.mean() << " " << naive[i].g.mean();
            sums[0] += withNextEvent[i].g.mean();
            sums[1] += naive[i].g.mean();
        }
        EXPECT_GT(sums[0], 0);
        EXPECT_NEAR(sums[0] / sums[1], 1, 0.03);
    }
}

TEST(ReferencePathTracer, RussianRouletteKeepsTheMean) {
    const PathTracer tracer(mixedScene());
    PathTracerOptions options{.maxPathLength = 6};
    const auto with = tracer.image(4, 2, options, 4000, 66);
    options.russianRoulette = false;
    const auto without = tracer.image(4, 2, options, 4000, 67);
    for (size_t i = 0; i < with.size(); ++i) {
        EXPECT_GT(welchTest(with[i].g, without[i].g).pValue, bonferroni(0.01, 8)) << "pixel " << i;
    }
}

TEST(ReferencePathTracer, SaysWhatItCannotRender) {
    Scene scene = floorScene(0.5f);
    EXPECT_THROW(PathTracer{scene}, Error) << "no light";
    scene.pointLights.push_back({{0, 0, 1}, Vec3f(1.0f)});
    Random random(68);
    EXPECT_THROW(PathTracer(scene).radiance(rayToFloor(0), {.russianRoulette = false}, random), Error);
    scene.materials[0].kind = MaterialKind::MetallicRoughness;
    scene.materials[0].transmission = 0.5f;
    EXPECT_THROW(PathTracer{scene}, Error);
}

}  // namespace
}  // namespace antipode::reference
