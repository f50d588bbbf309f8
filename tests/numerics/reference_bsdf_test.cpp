// The reference BSDFs: sampler against pdf (χ²), weight against f·cos/pdf, energy, reciprocity, closed forms.
#include "support/reference/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "gpu/loss_tables.h"
#include "support/closed_forms.h"
#include "support/direction_sampler.h"
#include "support/reference/geometry.h"
#include "support/reference/microfacet.h"

namespace antipode::reference {
namespace {

struct Case {
    const char* name;
    Material material;
    double angle;  ///< of wo from the front normal, degrees; beyond 90 behind the surface
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Material make(MaterialKind kind, float baseColor, float specular, float exponent, float roughness) {
    Material m;
    m.kind = kind;
    m.baseColor = Vec3f(baseColor);
    m.specular = Vec3f(specular);
    m.phongExponent = exponent;
    m.roughness = roughness;
    return m;
}

std::vector<Case> roughCases() {
    const Material lambert = make(MaterialKind::Lambert, 0.8f, 0, 0, 1);
    const Material phong = make(MaterialKind::Phong, 0.1f, 0.7f, 20, 1),
                   gloss = make(MaterialKind::Phong, 0, 0.9f, 4, 1);
    const Material metal = make(MaterialKind::RoughConductor, 0, 0, 0, 0.6f);
    const Material glass = make(MaterialKind::RoughDielectric, 0, 0, 0, 0.65f);
    Material paint = make(MaterialKind::MetallicRoughness, 0.7f, 1, 0, 0.5f), lacquer = paint, velvet = paint;
    paint.metallic = 0.3f;
    lacquer.metallic = 0.6f;
    lacquer.clearcoat = 0.9f;
    lacquer.clearcoatRoughness = 0.3f;
    velvet.sheenColor = Vec3f(0.9f);
    velvet.sheenRoughness = 0.5f;
    Material both = lacquer;
    both.sheenColor = Vec3f(0.6f);
    both.sheenRoughness = 0.3f;
    return {{"Paint", paint, 50},
            {"PaintGrazing", paint, 85},
            {"Lacquer", lacquer, 40},
            {"LacquerGrazing", lacquer, 85},
            {"LacquerBack", lacquer, 130},
            {"Velvet", velvet, 30},
            {"VelvetGrazing", velvet, 85},
            {"LacqueredVelvet", both, 65},
            {"LambertFront", lambert, 30},
            {"LambertBack", lambert, 120},
            {"Phong", phong, 40},
            {"PhongGrazing", phong, 80},
            {"PhongLobeOnly", gloss, 60},
            {"Conductor", metal, 35},
            {"ConductorGrazing", metal, 85},
            {"ConductorBack", metal, 130},
            {"DielectricOutside", glass, 30},
            {"DielectricGrazing", glass, 80},
            {"DielectricInside", glass, 160},
            {"DielectricTotal", glass, 125}};
}

Vec3d directionAt(double degrees, double azimuth = 0.7) {
    const double theta = degrees * kPi / 180;
    return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)};
}

class RoughBsdf : public testing::TestWithParam<Case> {};

/// Null hypothesis: sampleBsdf follows pdfBsdf. α = .01 over all cases (Bonferroni), seed 21.
TEST_P(RoughBsdf, SamplerFollowsPdf) {
    const auto& [name, material, angle] = GetParam();
    const Vec3d wo = directionAt(angle);
    const auto report = testDirectionSampler(
        [&](Random& random) -> std::optional<Vec3d> {
            const auto s = sampleBsdf(material, wo, random);
            return s ? std::optional(s->wi) : std::nullopt;
        },
        [&](const Vec3d& wi) { return pdfBsdf(material, wo, wi); }, 1000000, 21);
    EXPECT_GT(report.chiSquare.pValue, bonferroni(0.01, roughCases().size()));
    EXPECT_EQ(report.zeroPdf, 0u);
    EXPECT_LT(report.integral, 1 + 1e-4);
    EXPECT_NEAR(report.integral, 1 - report.emptyShare, 2e-3);
}

TEST_P(RoughBsdf, WeightIsBsdfOverPdfAndReflectsNoMoreThanArrives) {
    const auto& [name, material, angle] = GetParam();
    const Vec3d wo = directionAt(angle);
    Random random(22);
    Moments albedo;
    for (int i = 0; i < 20000; ++i) {
        const auto s = sampleBsdf(material, wo, random);
        if (!s) {
            albedo.add(0);
            continue;
        }
        const double expected = evalBsdf(material, wo, s->wi).x * std::abs(s->wi.z) / pdfBsdf(material, wo, s->wi);
        ASSERT_NEAR(s->weight.x, expected, 1e-9 * expected);
        // Radiance grows by n² on its way into glass; in terms of power that factor drops out.
        const double ior = wo.z > 0 ? material.ior : 1 / material.ior;
        albedo.add(s->weight.x * (wo.z * s->wi.z < 0 ? ior * ior : 1));
    }
    EXPECT_LE(albedo.mean() - 4 * std::sqrt(albedo.meanVariance()), albedoBound(material) * (1 + 1e-12));
}

/// f is symmetric for reflection; through an interface f(wo, wi)·n(wi)² is (Veach 1997, 5.2).
TEST_P(RoughBsdf, Reciprocity) {
    const auto& [name, material, angle] = GetParam();
    const Vec3d wo = directionAt(angle);
    const auto squaredIndex = [&](const Vec3d& w) {
        return material.kind == MaterialKind::RoughDielectric && w.z < 0 ? double(material.ior) * material.ior : 1.0;
    };
    Random random(23);
    for (int i = 0; i < 500; ++i) {
        const Vec3d wi = directionAt(random.uniform(1, 179), random.uniform(0, 6));
        const double forward = evalBsdf(material, wo, wi).x * squaredIndex(wi);
        const double reverse = evalBsdf(material, wi, wo).x * squaredIndex(wo);
        EXPECT_NEAR(forward, reverse, 1e-9 * (forward + reverse));
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, RoughBsdf, testing::ValuesIn(roughCases()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ReferenceBsdf, OneSidedMaterialsAreBlackBehind) {
    for (const MaterialKind kind : {MaterialKind::Lambert, MaterialKind::Phong, MaterialKind::Mirror}) {
        Material m = make(kind, 0.5f, 0.5f, 5, 1);
        m.twoSided = false;
        Random random(24);
        EXPECT_FALSE(sampleBsdf(m, directionAt(120), random));
        EXPECT_EQ(maxComponent(evalBsdf(m, directionAt(120), directionAt(130))), 0);
        EXPECT_EQ(pdfBsdf(m, directionAt(120), directionAt(130)), 0);
    }
}

TEST(ReferenceBsdf, FresnelEqualsClosedForm) {
    for (double angle = 0.05; angle < 1.57; angle += 0.1)
        for (const double n : {1.5, 1 / 1.5, 1.0001}) {
            EXPECT_NEAR(fresnelDielectric(std::cos(angle), n), closed_forms::fresnel(angle, n), 1e-12);
            EXPECT_NEAR(fresnelConductor(std::cos(angle), 1.5, 0), closed_forms::fresnel(angle, 1.5), 1e-12);
        }
}

/// Null hypothesis: the mean weight of a conductor that reflects everything is GGX's single-scattering albedo and what
/// the table says that this loses. α = .01 over four tests, seed 25.
TEST(ReferenceBsdf, WhiteMetalKeepsWhatTheTableSaysIsLost) {
    for (const double alpha : {0.5, 1.0})
        for (const double mu : {1.0, 0.5}) {
            Material m = make(MaterialKind::RoughConductor, 0, 0, 0, float(std::sqrt(alpha)));
            m.conductorEta = Vec3f(1.0f);
            m.conductorK = Vec3f(1e9f);  // F = 1 to 1e-9
            Random random(25);
            Moments moments;
            for (int i = 0; i < 50000; ++i) {
                const auto s = sampleBsdf(m, directionAt(std::acos(mu) * 180 / kPi), random);
                moments.add(s ? s->weight.x : 0);
            }
            const double alphaInFloat = double(m.roughness) * m.roughness;
            const auto result = tTest(
                moments, closed_forms::ggxSingleScatterAlbedo(alphaInFloat, mu) + tabulatedMetalLoss(mu, alphaInFloat));
            EXPECT_GT(result.pValue, bonferroni(0.01, 4))
                << "alpha " << alpha << " mu " << mu << ": " << moments.mean();
        }
}

/// A nearly smooth rough dielectric transmits what a smooth one does (α = 1e-4).
TEST(ReferenceBsdf, RoughDielectricTendsToSmooth) {
    const Material rough = make(MaterialKind::RoughDielectric, 0, 0, 0, 0.01f);
    for (const double angle : {20.0, 60.0, 150.0}) {
        const Vec3d wo = directionAt(angle);
        Random random(26);
        double reflected = 0, transmitted = 0;
        const int samples = 100000;
        for (int i = 0; i < samples; ++i) {
            const auto s = sampleBsdf(rough, wo, random);
            if (!s) continue;
            (s->wi.z * wo.z > 0 ? reflected : transmitted) += s->weight.x / samples;
        }
        const double n = wo.z > 0 ? 1.5 : 1 / 1.5, F = fresnelDielectric(std::abs(wo.z), n);
        EXPECT_NEAR(reflected, F, 5e-3);
        EXPECT_NEAR(transmitted * n * n, 1 - F, 5e-3);
    }
}

}  // namespace
}  // namespace antipode::reference
