#include "support/reference/layered.h"

#include <algorithm>
#include <cmath>

#include "gpu/layer_tables.h"
#include "gpu/loss_tables.h"
#include "support/reference/geometry.h"
#include "support/reference/microfacet.h"

namespace antipode::reference {
namespace {

constexpr double leastAlpha = 2.5e-4, coatIor = 1.5;

double alphaOf(double roughness) { return std::max(roughness * roughness, leastAlpha); }

double schlick(double cosine, double f0, double f90) { return f0 + (f90 - f0) * std::pow(1 - cosine, 5); }

/// The base: a Schlick layer of GGX facets over a diffuse body, partly metal.
struct Base {
    explicit Base(const Material& m) : alpha(alphaOf(m.roughness)), metallic(m.metallic), f90(m.specularFactor) {
        const double root = (double(m.ior) - 1) / (double(m.ior) + 1);
        const double meanLoss = tabulatedMetalMeanLoss(alpha);
        for (int i = 0; i < 3; ++i) {
            const double dielectric = std::min(root * root * double(m.specular[i]), 1.0) * double(m.specularFactor);
            const double color = m.baseColor[i];
            f0 = std::max(f0, dielectric);
            facetF0[i] = std::lerp(dielectric, color, metallic);
            diffuse[i] = color * (1 - metallic);
            const double F = color + (1 - color) / 21;
            multiple[i] = metallic * F * F * (1 - meanLoss) / (1 - F * meanLoss);
        }
        facetF90 = std::lerp(f90, 1.0, metallic);
    }

    double alpha, metallic, f0 = 0, f90, facetF90 = 0;
    Vec3d facetF0, diffuse, multiple;

    double loss(double cosine) const { return tabulatedMetalLoss(cosine, alpha); }
    /// What the dielectric layer lets through to the diffuse body.
    double passed(double cosine) const { return 1 - schlick(cosine, f0, f90); }

    Vec3d facets(const Vec3d& wo, const Vec3d& wi) const {
        const Vec3d h = normalize(wo + wi);
        const double value = ggxDistribution(h, alpha) * ggxShadowing(wo, wi, alpha) / (4 * wo.z * wi.z);
        Vec3d result = multiple * (loss(wo.z) * loss(wi.z) / (kPi * tabulatedMetalMeanLoss(alpha)));
        for (int i = 0; i < 3; ++i) result[i] += schlick(dot(wo, h), facetF0[i], facetF90) * value;
        return result;
    }

    /// Albedos by which lobes are chosen: of the diffuse ones, and of the facets.
    double diffuseAlbedo(double cosine) const {
        return maxComponent(diffuse) * passed(cosine) + maxComponent(multiple) * loss(cosine);
    }
    double facetAlbedo(double cosine) const {
        double F = 0;
        for (int i = 0; i < 3; ++i) F = std::max(F, schlick(cosine, facetF0[i], facetF90));
        return F * (1 - maxComponent(multiple) * loss(cosine));
    }
    double albedo(double cosine) const { return diffuseAlbedo(cosine) + facetAlbedo(cosine); }
    double diffuseChance(double cosine) const {
        return albedo(cosine) > 0 ? diffuseAlbedo(cosine) / albedo(cosine) : 1;
    }
};

double sheenRoughness(const Material& m) { return std::max(double(m.sheenRoughness), leastSheenRoughness); }

double sheenAlbedo(const Material& m, double cosine) {
    return maxComponent(m.sheenColor) * tabulatedSheenAlbedo(cosine, sheenRoughness(m));
}

double coatAlbedo(const Material& m, double cosine) {
    return double(m.clearcoat) * tabulatedCoatAlbedo(cosine, m.clearcoatRoughness);
}

double share(double albedo, double below) { return albedo > 0 ? albedo / (albedo + (1 - albedo) * below) : 0; }

double sheenChance(const Material& m, const Base& base, double cosine) {
    return share(sheenAlbedo(m, cosine), base.albedo(cosine));
}

double coatChance(const Material& m, const Base& base, double cosine) {
    const double sheen = sheenAlbedo(m, cosine);
    return share(coatAlbedo(m, cosine), sheen + (1 - sheen) * base.albedo(cosine));
}

double pdfFacets(const Vec3d& wo, const Vec3d& wi, double alpha) {
    const Vec3d h = normalize(wo + wi);
    return pdfVisibleNormal(wo, h, alpha) / (4 * dot(wo, h));
}

Vec3d drawFacets(const Vec3d& wo, double alpha, Random& random) {
    const double u1 = random.uniform(), u2 = random.uniform();
    const Vec3d h = sampleVisibleNormal(wo, alpha, u1, u2);
    return h * (2 * dot(wo, h)) - wo;
}

double sheenFit(double x, double alpha) {
    const double s = (1 - alpha) * (1 - alpha);
    const double from[] = {21.5473, 3.82987, 0.19823, -1.97760, -4.32054},
                 to[] = {25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
    double p[5];
    for (int i = 0; i < 5; ++i) p[i] = (1 - s) * from[i] + s * to[i];
    return p[0] / (1 + p[1] * std::pow(x, p[2])) + p[3] * x + p[4];
}

double sheenLambda(double cosine, double alpha) {
    return std::exp(cosine < 0.5 ? sheenFit(cosine, alpha) : 2 * sheenFit(0.5, alpha) - sheenFit(1 - cosine, alpha));
}

}  // namespace

double sheenValue(const Vec3d& wo, const Vec3d& wi, double alpha) {
    constexpr double leastCosine = 1e-4;
    const Vec3d h = normalize(wo + wi);
    const double o = std::clamp(wo.z, leastCosine, 1.0), i = std::clamp(wi.z, leastCosine, 1.0);
    const double D = (2 + 1 / alpha) * std::pow(std::hypot(h.x, h.y), 1 / alpha) / (2 * kPi);
    return D / ((1 + sheenLambda(o, alpha) + sheenLambda(i, alpha)) * 4 * o * i);
}

double coatValue(const Vec3d& wo, const Vec3d& wi, double alpha) {
    const Vec3d h = normalize(wo + wi);
    return fresnelDielectric(dot(wo, h), coatIor) * ggxDistribution(h, alpha) * ggxShadowing(wo, wi, alpha) /
           (4 * wo.z * wi.z);
}

Vec3d evalLayered(const Material& m, const Vec3d& wo, const Vec3d& wi) {
    const Base base(m);
    const double coatO = 1 - coatAlbedo(m, wo.z), coatI = 1 - coatAlbedo(m, wi.z), coatLeast = std::min(coatO, coatI),
                 sheenLeast = std::min(1 - sheenAlbedo(m, wo.z), 1 - sheenAlbedo(m, wi.z));
    // The mean over the cosine-weighted hemisphere of what Schlick's layer and the coat let through.
    const double coat = m.clearcoat, mean = tabulatedCoatMeanAlbedo(m.clearcoatRoughness),
                 schlickMean = tabulatedCoatSchlickMean(m.clearcoatRoughness);
    const double through = (1 - base.f0) * (1 - coat * mean) - (base.f90 - base.f0) * (1.0 / 21 - coat * schlickMean);
    const double scale = through > 0 ? base.passed(wo.z) * base.passed(wi.z) * coatO * coatI / through : 0;
    const Vec3d below = base.diffuse * (scale / kPi) + base.facets(wo, wi) * coatLeast;
    Vec3d result = below * sheenLeast;
    if (maxComponent(m.sheenColor) > 0)
        result += Vec3d(m.sheenColor) * (sheenValue(wo, wi, std::pow(sheenRoughness(m), 2)) * coatLeast);
    return result + Vec3d(coat * coatValue(wo, wi, alphaOf(m.clearcoatRoughness)));
}

double pdfLayered(const Material& m, const Vec3d& wo, const Vec3d& wi) {
    const Base base(m);
    const double coat = coatChance(m, base, wo.z), sheen = sheenChance(m, base, wo.z),
                 diffuse = base.diffuseChance(wo.z);
    const double below = diffuse * wi.z / kPi + (1 - diffuse) * pdfFacets(wo, wi, base.alpha);
    return coat * pdfFacets(wo, wi, alphaOf(m.clearcoatRoughness)) +
           (1 - coat) * (sheen / (2 * kPi) + (1 - sheen) * below);
}

Vec3d sampleLayered(const Material& m, const Vec3d& wo, Random& random) {
    const Base base(m);
    if (random.uniform() < coatChance(m, base, wo.z)) return drawFacets(wo, alphaOf(m.clearcoatRoughness), random);
    const bool sheen = random.uniform() < sheenChance(m, base, wo.z);
    if (!sheen && random.uniform() >= base.diffuseChance(wo.z)) return drawFacets(wo, base.alpha, random);
    const double u = random.uniform(), z = sheen ? u : std::sqrt(u), r = std::sqrt(1 - z * z),
                 phi = 2 * kPi * random.uniform();
    return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace antipode::reference
