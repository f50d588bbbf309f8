// The closed forms against the digits that the design of the tests states for them.
#include "support/closed_forms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antipode::closed_forms {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180;

TEST(ClosedForms, Furnaces) {
    EXPECT_DOUBLE_EQ(whiteFurnace(0.8, 2), 1.6);
    EXPECT_DOUBLE_EQ(radianceInsideGlass(1.5, 1), 2.25);
    const double expected[] = {1, 1.5, 1.75, 1.875};
    for (uint32_t bounces = 0; bounces < 4; ++bounces) {
        EXPECT_DOUBLE_EQ(closedFurnace(1, 0.5, bounces), expected[bounces]);
        EXPECT_DOUBLE_EQ(facingMirrors(1, 0.5, bounces), expected[bounces]);
    }
    EXPECT_DOUBLE_EQ(closedFurnace(1, 0.5), 2);
    EXPECT_NEAR(closedFurnace(1, 0.8), 5, 1e-14);
    EXPECT_DOUBLE_EQ(closedFurnace(1, 1, 9), 10);
    EXPECT_NEAR(integratingSphere(0.5, 1, 1), 0.318310, 5e-7);
}

TEST(ClosedForms, PlaneUnderLights) {
    EXPECT_NEAR(0.5 / kPi * irradianceOfPointLight(100, 2, 0), 3.978874, 5e-7);
    EXPECT_NEAR(0.5 / kPi * irradianceOfPointLight(100, 2, 2), 1.406744, 5e-7);
    EXPECT_NEAR(irradianceOfSphereLight(1, 1, 3, 0) / kPi, 0.111111, 5e-7);
    EXPECT_NEAR(irradianceOfSphereLight(1, 1, 3, 4) / kPi, 0.024, 5e-7);
    EXPECT_NEAR(irradianceOfDiskLight(1, 1, 1, 0), 1.570796, 5e-7);
    EXPECT_NEAR(irradianceOfDiskLight(1, 1, 1, 1), 0.868315, 5e-7);
    EXPECT_NEAR(irradianceOfDiskLight(1, 1, 1, 2), 0.165833, 5e-7);
    EXPECT_NEAR(formFactorUnderCentre(2, 2, 1), 0.554126, 5e-7);
    EXPECT_NEAR(formFactorUnderCentre(2, 2, 2), 0.239456, 5e-7);
    EXPECT_NEAR(formFactorUnderCorner(2, 2, 1), 0.207757, 5e-7);
}

TEST(ClosedForms, FormFactorsOfSquares) {
    EXPECT_NEAR(formFactorParallelSquares(1), 0.199825, 5e-7);
    EXPECT_NEAR(formFactorParallelSquares(2), 0.068590, 5e-7);
    EXPECT_NEAR(formFactorParallelSquares(0.5), 0.415253, 5e-7);
    EXPECT_NEAR(formFactorPerpendicularSquares(), 0.200044, 5e-7);
}

TEST(ClosedForms, Fresnel) {
    EXPECT_NEAR(fresnel(0, 1.5), 0.04, 1e-15);
    EXPECT_NEAR(fresnelS(45 * kDegree, 1.5), 0.092013, 5e-7);
    EXPECT_NEAR(fresnelP(45 * kDegree, 1.5), 0.008466, 5e-7);
    EXPECT_NEAR(fresnelS(60 * kDegree, 1.5), 0.176571, 5e-7);
    EXPECT_NEAR(fresnelP(60 * kDegree, 1.5), 0.001802, 5e-7);
    EXPECT_NEAR(criticalAngle(1.5) / kDegree, 41.8103, 5e-5);
    EXPECT_NEAR(brewsterAngle(1.5) / kDegree, 56.3099, 5e-5);
    EXPECT_NEAR(fresnelP(brewsterAngle(1.5), 1.5), 0, 1e-30);
    EXPECT_NEAR(fresnelCosineHemispherical(1.5), 0.091778, 5e-7);
    EXPECT_NEAR(fresnelCosineHemispherical(1 / 1.5), 0.596346, 5e-7);
    // Reciprocity of the two sides: what enters under uniform light also leaves.
    EXPECT_NEAR(1 - fresnelCosineHemispherical(1 / 1.5), (1 - fresnelCosineHemispherical(1.5)) / 2.25, 1e-9);
}

TEST(ClosedForms, SlabAndItsCaustic) {
    EXPECT_NEAR(slabTransmittance(0, 1.5), 0.923077, 5e-7);
    EXPECT_NEAR(slabTransmittance(45 * kDegree, 1.5), 0.904327, 5e-7);
    EXPECT_NEAR(slabTransmittance(60 * kDegree, 1.5), 0.836232, 5e-7);
    EXPECT_NEAR(slabCaustic(0.5, 2, 60 * kDegree, 1.5), 0.836232 / 2 / kPi, 5e-7);
}

TEST(ClosedForms, BallLens) {
    const double r[] = {0.1, 0.2, 0.3, 0.5, 0.8}, expected[] = {0.894, 0.819, 0.718, 0.510, 0.286};
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(ballLensIrradiance(1.5, 3, r[i]), expected[i], 5e-4) << r[i];
    EXPECT_NEAR(ballLensTransmittance(1.5), 0.835544, 5e-7);
}

TEST(ClosedForms, GgxSingleScatter) {
    // The two values without a closed form: midpoint rule over the incident direction, 1500 × 600 nodes.
    EXPECT_NEAR(ggxSingleScatterAlbedo(0.5, 1), 0.687849, 5e-7);
    EXPECT_NEAR(ggxSingleScatterAlbedo(1, 1), 1 - std::log(2), 1e-8);
    EXPECT_NEAR(ggxSingleScatterAlbedo(1, 0.5), 0.450694, 5e-7);
}

}  // namespace
}  // namespace antipode::closed_forms
