// The tabulated albedos of layers against quadrature of another kind, over the reference's values.
#include "gpu/layer_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "gpu/loss_tables.h"
#include "support/closed_forms.h"
#include "support/reference/geometry.h"
#include "support/reference/layered.h"

namespace antipode {
namespace {

/// ∫f cosθ dω over the hemisphere: even in the cosine, and in the root of the azimuth from where a mirror would lead,
/// about which lobes at grazing angles are narrow.
double albedoOf(double cosine, const std::function<double(const Vec3d& wo, const Vec3d& wi)>& f) {
    constexpr int heights = 600, azimuths = 400;
    const Vec3d wo{std::sqrt(1 - cosine * cosine), 0, cosine};
    double sum = 0;
    for (int i = 0; i < heights; ++i)
        for (int j = 0; j < azimuths; ++j) {
            const double z = (i + 0.5) / heights, r = std::sqrt(1 - z * z), root = (j + 0.5) / azimuths,
                         phi = reference::kPi * (1 - root * root);
            sum += f(wo, {r * std::cos(phi), r * std::sin(phi), z}) * z * 2 * root;
        }
    return sum * 2 * reference::kPi / (heights * azimuths);
}

TEST(LayerTables, CoatsReflectWhatTheirFacetsDo) {
    for (double roughness : {0.3, 0.45, 0.7, 1.0})
        for (double cosine : {0.05, 0.2, 0.5, 0.8, 1.0}) {
            const double alpha = roughness * roughness;
            const double albedo =
                albedoOf(cosine, [&](const Vec3d& wo, const Vec3d& wi) { return reference::coatValue(wo, wi, alpha); });
            EXPECT_NEAR(tabulatedCoatAlbedo(cosine, roughness), albedo, 1e-3)
                << "roughness " << roughness << ", cosine " << cosine;
        }
}

TEST(LayerTables, SmoothCoatsAreFresnels) {
    for (double cosine : {0.1, 0.3, 0.5, 0.9, 1.0})
        EXPECT_NEAR(tabulatedCoatAlbedo(cosine, 0), closed_forms::fresnel(std::acos(cosine), 1.5), 1e-3) << cosine;
    EXPECT_NEAR(tabulatedCoatMeanAlbedo(0), closed_forms::fresnelCosineHemispherical(1.5), 1e-3);
}

TEST(LayerTables, SheenReflectsWhatItsFibresDo) {
    for (double roughness : {0.26, 0.4, 0.7, 1.0})
        for (double cosine : {0.05, 0.2, 0.5, 0.8, 1.0}) {
            const double alpha = roughness * roughness;
            const double albedo = albedoOf(
                cosine, [&](const Vec3d& wo, const Vec3d& wi) { return reference::sheenValue(wo, wi, alpha); });
            EXPECT_NEAR(tabulatedSheenAlbedo(cosine, roughness), albedo, 1e-3)
                << "roughness " << roughness << ", cosine " << cosine;
        }
}

/// What a layer reflects is part of what arrives, also at grazing angles, so that no scale of what it covers is
/// negative.
TEST(LayerTables, NothingReflectsMoreThanArrives) {
    for (double step = 0; step <= 1; step += 1.0 / 256)
        for (double at = 0; at <= 1; at += 1.0 / 512) {
            const double roughness = std::lerp(leastSheenRoughness, 1.0, step);
            EXPECT_LT(tabulatedSheenAlbedo(at * at, roughness), 1)
                << "roughness " << roughness << ", cosine " << at * at;
            EXPECT_LT(tabulatedCoatAlbedo(at * at, step), 1) << "roughness " << step << ", cosine " << at * at;
        }
}

/// The means are those of what is interpolated.
TEST(LayerTables, MeansAreThoseOfTheAlbedos) {
    for (double roughness : {0.0, 0.1, 0.37, 1.0}) {
        double mean = 0, schlick = 0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double cosine = (i + 0.5) / steps,
                         share = 2 * cosine * tabulatedCoatAlbedo(cosine, roughness) / steps;
            mean += share;
            schlick += share * std::pow(1 - cosine, 5);
        }
        EXPECT_NEAR(tabulatedCoatMeanAlbedo(roughness) / mean, 1, 1e-4) << roughness;
        EXPECT_NEAR(tabulatedCoatSchlickMean(roughness) / schlick, 1, 1e-3) << roughness;
    }
}

TEST(LayerTables, ArePackedByTheCell) {
    const auto texels = packLayerAlbedos();
    constexpr size_t cells = (shared::ALBEDO_COSINES - 1) * (shared::ALBEDO_ROUGHNESSES - 1),
                     means = shared::ALBEDO_ROUGHNESSES - 1;
    ASSERT_EQ(texels.size(), 2 * cells + means);
    EXPECT_EQ(double(texels[cells - 1].w), tabulatedCoatAlbedo(1, 1));
    EXPECT_EQ(double(texels[cells].x), tabulatedCoatMeanAlbedo(0));
    EXPECT_EQ(double(texels[cells + means - 1].w), tabulatedCoatSchlickMean(1));
    EXPECT_EQ(double(texels.back().w), tabulatedSheenAlbedo(1, 1));
}

}  // namespace
}  // namespace antipode
