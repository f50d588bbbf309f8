#include "support/reference/bsdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "gpu/loss_tables.h"
#include "renderengine/error.h"
#include "support/reference/geometry.h"
#include "support/reference/layered.h"
#include "support/reference/microfacet.h"

namespace antipode::reference {
namespace {

Vec3d sampleCosineHemisphere(Random& random) {
    const double u = random.uniform(), r = std::sqrt(u), phi = 2 * kPi * random.uniform();
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
}

Vec3d mirrored(const Vec3d& w) { return {-w.x, -w.y, w.z}; }

Vec3d reflectAbout(const Vec3d& w, const Vec3d& m) { return m * (2 * dot(w, m)) - w; }

double alphaOf(const Material& material) { return double(material.roughness) * material.roughness; }

/// Flips a two-sided opaque material's local frame so that wo is in front; false where the back is black.
bool faceForward(const Material& material, Vec3d& wo, Vec3d& wi) {
    if (wo.z > 0) return true;
    wo.z = -wo.z;
    wi.z = -wi.z;
    return material.twoSided;
}

// --- Modified Phong: f = kd/π + ks(n+2)/(2π)·cosⁿα, α between wi and the mirrored wo (Lafortune & Willems 1994) ---

double phongDiffuseProbability(const Material& material) {
    const double diffuse = maxComponent(material.baseColor), specular = maxComponent(material.specular);
    return diffuse + specular > 0 ? diffuse / (diffuse + specular) : 1;
}

Vec3d evalPhong(const Material& material, const Vec3d& wo, const Vec3d& wi) {
    const double n = material.phongExponent, cosAlpha = std::max(0.0, dot(wi, mirrored(wo)));
    return Vec3d(material.baseColor) / kPi + Vec3d(material.specular) * ((n + 2) / (2 * kPi) * std::pow(cosAlpha, n));
}

double pdfPhong(const Material& material, const Vec3d& wo, const Vec3d& wi) {
    const double n = material.phongExponent, cosAlpha = std::max(0.0, dot(wi, mirrored(wo)));
    const double diffuse = phongDiffuseProbability(material);
    return diffuse * wi.z / kPi + (1 - diffuse) * (n + 1) / (2 * kPi) * std::pow(cosAlpha, n);
}

Vec3d samplePhongDirection(const Material& material, const Vec3d& wo, Random& random) {
    if (random.uniform() < phongDiffuseProbability(material)) return sampleCosineHemisphere(random);
    const double cosAlpha = std::pow(1 - random.uniform(), 1 / (material.phongExponent + 1.0));
    const double sinAlpha = std::sqrt(1 - cosAlpha * cosAlpha), phi = 2 * kPi * random.uniform();
    return Frame(mirrored(wo)).toWorld({sinAlpha * std::cos(phi), sinAlpha * std::sin(phi), cosAlpha});
}

// --- GGX conductor (Walter et al. 2007, eq. 20) ---

Vec3d conductorReflectance(const Material& material, double cosine) {
    const auto channel = [&](int i) {
        return fresnelConductor(cosine, material.conductorEta[i], material.conductorK[i]);
    };
    return {channel(0), channel(1), channel(2)};
}

Vec3d evalConductor(const Material& material, const Vec3d& wo, const Vec3d& wi) {
    const double alpha = alphaOf(material);
    const Vec3d m = normalize(wo + wi);
    return conductorReflectance(material, std::abs(dot(wo, m))) *
           (ggxDistribution(m, alpha) * ggxShadowing(wo, wi, alpha) / (4 * wo.z * wi.z));
}

double pdfConductor(const Material& material, const Vec3d& wo, const Vec3d& wi) {
    const Vec3d m = normalize(wo + wi);
    return pdfVisibleNormal(wo, m, alphaOf(material)) / (4 * std::abs(dot(wo, m)));
}

// --- What rough metal scatters more than once (Kulla and Conty 2017). The losses are tabulated, so that the model is
// --- the tables'; tests/gpu/loss_tables_test.cpp holds these to closed forms.

/// The reflectance of a facet, weighted by the cosine.
Vec3d meanReflectance(const Material& material) {
    using Index = std::array<float, 6>;
    thread_local std::map<Index, Vec3d> known;
    const Vec3f &eta = material.conductorEta, &k = material.conductorK;
    const auto [at, isNew] = known.try_emplace(Index{eta.x, eta.y, eta.z, k.x, k.y, k.z});
    constexpr int steps = 2000;
    if (isNew)
        for (int i = 0; i < steps; ++i)
            at->second = at->second + conductorReflectance(material, std::sqrt((i + 0.5) / steps)) / steps;
    return at->second;
}

/// Albedo of the lobe over what single scattering loses.
Vec3d multipleScattering(const Material& material) {
    const double lost = tabulatedMetalMeanLoss(alphaOf(material));
    Vec3d share = meanReflectance(material);
    for (int i = 0; i < 3; ++i) {
        // Twice reflected, thrice, and so on: each time what is lost of it meets another facet.
        const double F = share[i];
        share[i] = F * F * (1 - lost) / (1 - F * lost);
    }
    return share;
}

Vec3d evalMultipleScattering(const Material& material, const Vec3d& wo, const Vec3d& wi) {
    const double alpha = alphaOf(material);
    return multipleScattering(material) *
           (tabulatedMetalLoss(wo.z, alpha) * tabulatedMetalLoss(wi.z, alpha) / (kPi * tabulatedMetalMeanLoss(alpha)));
}

double multipleScatteringChance(const Material& material, double cosine) {
    const double loss = tabulatedMetalLoss(cosine, alphaOf(material));
    const double multiple = maxComponent(multipleScattering(material)) * loss;
    return multiple / (multiple + maxComponent(meanReflectance(material)) * (1 - loss));
}

// --- GGX dielectric (Walter et al. 2007, eqs. 20 and 21). wo is in front here; `ior` is then index at -z over at +z
// ---

/// The microfacet normal on wo's side that leads from wo to wi; empty where none does.
std::optional<Vec3d> dielectricNormal(const Vec3d& wo, const Vec3d& wi, double ior) {
    const Vec3d sum = wi.z > 0 ? wo + wi : wo + wi * ior;
    if (dot(sum, sum) == 0) return {};
    Vec3d m = normalize(sum);
    if (m.z < 0) m = -m;
    // Facets seen from behind do not scatter.
    if (dot(wo, m) <= 0 || dot(wi, m) * wi.z <= 0) return {};
    return m;
}

/// The Jacobian dω_m/dω_i of refraction.
double refractionJacobian(const Vec3d& wo, const Vec3d& wi, const Vec3d& m, double ior) {
    const double denominator = dot(wo, m) + ior * dot(wi, m);
    return ior * ior * std::abs(dot(wi, m)) / (denominator * denominator);
}

/// What single scattering loses leaves as a diffuse lobe on either side (Kulla and Conty 2017): of light from one side
/// the part `passed` beyond.
struct GlassMultiple {
    double meanLoss, meanLossBeyond, passed;
};

/// The parts are such that both ways through the interface are one function: passed·n²·meanLoss of either side is
/// that of the other, and neither is more than smooth glass passes of uniform light.
GlassMultiple glassMultiple(double alpha, double ior) {
    const double here = tabulatedGlassMeanLoss(alpha, ior), beyond = tabulatedGlassMeanLoss(alpha, 1 / ior);
    const double n = std::max(ior, 1 / ior), fromThin = 1 - (n - 1) / (4.08567 + 1.00071 * n);
    const double smooth = ior > 1 ? fromThin : fromThin / (n * n);
    return {here, beyond, smooth * beyond / std::max(here, beyond)};
}

double evalSingleDielectric(const Vec3d& wo, const Vec3d& wi, double alpha, double ior) {
    const auto m = dielectricNormal(wo, wi, ior);
    if (!m) return 0;
    const double F = fresnelDielectric(dot(wo, *m), ior);
    const double DG = ggxDistribution(*m, alpha) * ggxShadowing(wo, wi, alpha);
    if (wi.z > 0) return F * DG / (4 * wo.z * wi.z);
    // Radiance: the factor (index at wo/index at wi)² = 1/ior² turns the Jacobian's ior² into 1.
    return (1 - F) * DG * dot(wo, *m) / (wo.z * -wi.z) * refractionJacobian(wo, wi, *m, ior) / (ior * ior);
}

double evalRoughDielectric(const Vec3d& wo, const Vec3d& wi, double alpha, double ior) {
    const GlassMultiple g = glassMultiple(alpha, ior);
    const double lost = tabulatedGlassLoss(wo.z, alpha, ior);
    const double multiple =
        wi.z > 0 ? (1 - g.passed) * lost * tabulatedGlassLoss(wi.z, alpha, ior) / (kPi * g.meanLoss)
                 : g.passed * lost * tabulatedGlassLoss(-wi.z, alpha, 1 / ior) / (kPi * g.meanLossBeyond * ior * ior);
    return evalSingleDielectric(wo, wi, alpha, ior) + multiple;
}

double pdfSingleDielectric(const Vec3d& wo, const Vec3d& wi, double alpha, double ior) {
    const auto m = dielectricNormal(wo, wi, ior);
    if (!m) return 0;
    const double F = fresnelDielectric(dot(wo, *m), ior), visible = pdfVisibleNormal(wo, *m, alpha);
    if (wi.z > 0) return F * visible / (4 * dot(wo, *m));
    return (1 - F) * visible * refractionJacobian(wo, wi, *m, ior);
}

double pdfRoughDielectric(const Vec3d& wo, const Vec3d& wi, double alpha, double ior) {
    const double lost = tabulatedGlassLoss(wo.z, alpha, ior), passed = glassMultiple(alpha, ior).passed;
    return (1 - lost) * pdfSingleDielectric(wo, wi, alpha, ior) +
           lost * (wi.z > 0 ? 1 - passed : passed) * std::abs(wi.z) / kPi;
}

std::optional<Vec3d> sampleRoughDielectric(const Vec3d& wo, double alpha, double ior, Random& random) {
    if (random.uniform() < tabulatedGlassLoss(wo.z, alpha, ior)) {
        const Vec3d wi = sampleCosineHemisphere(random);
        return random.uniform() < glassMultiple(alpha, ior).passed ? Vec3d{wi.x, wi.y, -wi.z} : wi;
    }
    const double u1 = random.uniform(), u2 = random.uniform();
    const Vec3d m = sampleVisibleNormal(wo, alpha, u1, u2);
    const double cosine = dot(wo, m);
    if (cosine <= 0) return {};
    if (random.uniform() < fresnelDielectric(cosine, ior)) {
        const Vec3d wi = reflectAbout(wo, m);
        return wi.z > 0 ? std::optional(wi) : std::nullopt;
    }
    const double cosT = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const Vec3d wi = normalize(m * (cosine / ior - cosT) - wo / ior);
    return wi.z < 0 ? std::optional(wi) : std::nullopt;
}

/// Index behind over index in front, as seen from wo's side.
double relativeIor(const Material& material, const Vec3d& wo) {
    return wo.z > 0 || material.thin ? material.ior : 1.0 / material.ior;
}

// --- A pane of rough faces: both of them at once. What passes is what would be reflected, on the other side ---

double paneReflectance(double cosine, double ior) {
    const double F = fresnelDielectric(cosine, ior);
    double sum = F, onTheWay = (1 - F) * (1 - F) * F;
    for (int i = 0; i < 200; ++i, onTheWay *= F * F) sum += onTheWay;
    return sum;
}

double paneShare(const Vec3d& wo, const Vec3d& wi, double ior) {
    const Vec3d over{wi.x, wi.y, std::abs(wi.z)};
    const double R = paneReflectance(dot(wo, normalize(wo + over)), ior);
    return wi.z > 0 ? R : 1 - R;
}

/// Of what single scattering loses, as much is reflected as of uniform light.
double paneMultipleShare(const Vec3d& wi, double ior) {
    const double face = (ior - 1) / (4.08567 + 1.00071 * ior), reflected = 2 * face / (1 + face);
    return wi.z > 0 ? reflected : 1 - reflected;
}

double evalRoughPane(const Vec3d& wo, const Vec3d& wi, double alpha, double ior) {
    const Vec3d over{wi.x, wi.y, std::abs(wi.z)}, m = normalize(wo + over);
    const double single =
        paneShare(wo, wi, ior) * ggxDistribution(m, alpha) * ggxShadowing(wo, over, alpha) / (4 * wo.z * over.z);
    return single + paneMultipleShare(wi, ior) * tabulatedMetalLoss(wo.z, alpha) * tabulatedMetalLoss(over.z, alpha) /
                        (kPi * tabulatedMetalMeanLoss(alpha));
}

double pdfRoughPane(const Vec3d& wo, const Vec3d& wi, double alpha, double ior) {
    const Vec3d m = normalize(wo + Vec3d{wi.x, wi.y, std::abs(wi.z)});
    const double lost = tabulatedMetalLoss(wo.z, alpha);
    return (1 - lost) * paneShare(wo, wi, ior) * pdfVisibleNormal(wo, m, alpha) / (4 * dot(wo, m)) +
           lost * paneMultipleShare(wi, ior) * std::abs(wi.z) / kPi;
}

std::optional<BsdfSample> sampleSpecular(const Material& material, const Vec3d& wo, Random& random) {
    if (material.kind == MaterialKind::Mirror) {
        if (wo.z <= 0 && !material.twoSided) return {};
        return BsdfSample{mirrored(wo), Vec3d(material.specular), 1, true};
    }
    const double ior = relativeIor(material, wo), F = fresnelDielectric(std::abs(wo.z), ior);
    if (random.uniform() < F) return BsdfSample{mirrored(wo), Vec3d(1.0), F, true};
    return BsdfSample{*refract(wo, material.ior), Vec3d(1 / (ior * ior)), 1 - F, true};
}

}  // namespace

void requireSupported(const Material& material) {
    const bool textured = material.baseColorTexture || material.emissionTexture || material.metallicRoughnessTexture ||
                          material.normalTexture;
    if (material.thin || material.attenuationDistance || material.scatteringDistance)
        throw Error(ErrorCode::Usage,
                    "The reference renderer draws no paths through panes, and none that media absorb or scatter.");
    const bool rough = material.kind == MaterialKind::RoughConductor || material.kind == MaterialKind::RoughDielectric;
    const bool partlyGlass = material.kind == MaterialKind::MetallicRoughness && material.transmits();
    if (partlyGlass || textured || (rough && material.roughness <= 0))
        throw Error(ErrorCode::Usage, "The reference renderer cannot render material '" + material.name +
                                          "': textures, surfaces part glass and roughness 0 are not supported.");
}

bool isSpecular(const Material& material) {
    return material.kind == MaterialKind::Mirror || material.kind == MaterialKind::Dielectric;
}

double albedoBound(const Material& material) {
    switch (material.kind) {
        case MaterialKind::Lambert: return maxComponent(material.baseColor);
        case MaterialKind::Phong:
            return std::min(1.0f, maxComponent(material.baseColor) + maxComponent(material.specular));
        case MaterialKind::Mirror: return maxComponent(material.specular);
        default: return 1;
    }
}

double rouletteSurvival(const Material& material) { return std::min(albedoBound(material), 0.98); }

std::optional<Vec3d> refract(const Vec3d& wo, double ior) {
    const double relative = wo.z > 0 ? ior : 1 / ior;
    const double cosT2 = 1 - (1 - wo.z * wo.z) / (relative * relative);
    if (cosT2 <= 0) return {};
    return Vec3d{-wo.x / relative, -wo.y / relative, std::copysign(std::sqrt(cosT2), -wo.z)};
}

Vec3d evalBsdf(const Material& material, const Vec3d& woLocal, const Vec3d& wiLocal) {
    Vec3d wo = woLocal, wi = wiLocal;
    if (material.kind == MaterialKind::RoughDielectric) {
        const double ior = relativeIor(material, wo);
        if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
        if (wo.z == 0 || wi.z == 0) return {};
        return Vec3d(material.thin ? evalRoughPane(wo, wi, alphaOf(material), ior)
                                   : evalRoughDielectric(wo, wi, alphaOf(material), ior));
    }
    if (!faceForward(material, wo, wi) || wi.z <= 0 || wo.z == 0) return {};
    switch (material.kind) {
        case MaterialKind::Lambert: return Vec3d(material.baseColor) / kPi;
        case MaterialKind::Phong: return evalPhong(material, wo, wi);
        case MaterialKind::RoughConductor:
            return evalConductor(material, wo, wi) + evalMultipleScattering(material, wo, wi);
        case MaterialKind::MetallicRoughness: return evalLayered(material, wo, wi);
        default: return {};
    }
}

double pdfBsdf(const Material& material, const Vec3d& woLocal, const Vec3d& wiLocal) {
    Vec3d wo = woLocal, wi = wiLocal;
    if (material.kind == MaterialKind::RoughDielectric) {
        const double ior = relativeIor(material, wo);
        if (wo.z < 0) wo.z = -wo.z, wi.z = -wi.z;
        if (wo.z == 0 || wi.z == 0) return 0;
        return material.thin ? pdfRoughPane(wo, wi, alphaOf(material), ior)
                             : pdfRoughDielectric(wo, wi, alphaOf(material), ior);
    }
    if (!faceForward(material, wo, wi) || wi.z <= 0 || wo.z == 0) return 0;
    switch (material.kind) {
        case MaterialKind::Lambert: return wi.z / kPi;
        case MaterialKind::Phong: return pdfPhong(material, wo, wi);
        case MaterialKind::RoughConductor: {
            const double chance = multipleScatteringChance(material, wo.z);
            return (1 - chance) * pdfConductor(material, wo, wi) + chance * wi.z / kPi;
        }
        case MaterialKind::MetallicRoughness: return pdfLayered(material, wo, wi);
        default: return 0;
    }
}

double specularProbability(const Material& material, const Vec3d& wo, const Vec3d& wi) {
    if (material.kind == MaterialKind::Mirror) return 1;
    const double F = fresnelDielectric(std::abs(wo.z), relativeIor(material, wo));
    return wo.z * wi.z > 0 ? F : 1 - F;
}

std::optional<BsdfSample> sampleBsdf(const Material& material, const Vec3d& woLocal, Random& random) {
    if (woLocal.z == 0) return {};
    if (isSpecular(material)) return sampleSpecular(material, woLocal, random);
    const bool transmissive = material.kind == MaterialKind::RoughDielectric;
    if (woLocal.z < 0 && !material.twoSided && !transmissive) return {};

    const Vec3d wo{woLocal.x, woLocal.y, std::abs(woLocal.z)};
    std::optional<Vec3d> wi;
    switch (material.kind) {
        case MaterialKind::Lambert: wi = sampleCosineHemisphere(random); break;
        case MaterialKind::Phong: wi = samplePhongDirection(material, wo, random); break;
        case MaterialKind::RoughConductor: {
            if (random.uniform() < multipleScatteringChance(material, wo.z)) {
                wi = sampleCosineHemisphere(random);
                break;
            }
            const double u1 = random.uniform(), u2 = random.uniform();
            wi = reflectAbout(wo, sampleVisibleNormal(wo, alphaOf(material), u1, u2));
            break;
        }
        case MaterialKind::MetallicRoughness: wi = sampleLayered(material, wo, random); break;
        default: wi = sampleRoughDielectric(wo, alphaOf(material), relativeIor(material, woLocal), random);
    }
    if (!wi || (wi->z <= 0 && !transmissive)) return {};

    BsdfSample sample;
    sample.wi = {wi->x, wi->y, std::copysign(1.0, woLocal.z) * wi->z};
    sample.pdf = pdfBsdf(material, woLocal, sample.wi);
    if (!(sample.pdf > 0)) return {};
    sample.weight = evalBsdf(material, woLocal, sample.wi) * (std::abs(sample.wi.z) / sample.pdf);
    return sample;
}

}  // namespace antipode::reference
