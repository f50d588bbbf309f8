// evalBsdf's values: against the double-precision reference, reciprocity, densities of both ways, closed forms; and
// what the samplers do at the ends of the random numbers' range. Fixed seeds.
#include <cmath>

#include "gpu/layer_tables.h"
#include "support/closed_forms.h"
#include "support/hard_case.h"
#include "support/random.h"
#include "support/reference/bsdf.h"
#include "support/statistics.h"
#include "tests/kernels/bsdf_bench.h"
#include "tests/kernels/intersection_scenes.h"

namespace antipode {
namespace {

class BsdfValuesTest : public DeviceTest {
protected:
    BsdfValuesTest() : bench(*device, bsdfCases()) {}

    struct Pairs {
        std::vector<Vec3d> known, next;
    };

    /// Pairs of directions as the kernels see them: half of the second ones drawn by the material's own sampler.
    Pairs pairs(size_t index, size_t count, Random& random) {
        Pairs result;
        while (result.known.size() < count) {
            const Vec3d known = bench.rounded(randomDirection(random));
            if (std::abs(known.z) < 0.02) continue;
            const size_t block = 16;
            const auto drawn = bench.sample(index, known, uniformTexels(block, random));
            for (size_t k = 0; k < 2 * block; ++k) {
                if (k < block && (!drawn[k].valid || drawn[k].specular)) continue;
                const Vec3d next = bench.rounded(k < block ? drawn[k].direction : randomDirection(random));
                if (std::abs(next.z) < 0.02) continue;
                result.known.push_back(known);
                result.next.push_back(next);
            }
        }
        return result;
    }

    BsdfBench bench;
};

/// Relative error that rounded directions alone make: their 2⁻²³ over the angle that the lobe spans.
double tolerance(const BsdfCase& c) { return 1e-4 + 2e-6 / (c.lobeWidth * c.relativeLobeWidthBeyond); }

// The reference moved by rounding says how well the value is known at all; beyond that 10⁻⁴.
TEST_F(BsdfValuesTest, AgreeWithTheReference) {
    Random random(1);
    for (size_t index = 0; index < bsdfCases().size(); ++index) {
        Material m = bsdfCases()[index].material;
        if (m.kind == MaterialKind::MetallicRoughness && m.transmits()) continue;
        SCOPED_TRACE(bsdfCases()[index].name);
        const Pairs p = pairs(index, 3000, random);
        const auto values = bench.eval(index, p.known, p.next);
        size_t wrongValue = 0, wrongPdf = 0, positive = 0;
        for (size_t i = 0; i < p.known.size(); ++i) {
            // With exponent 0 the lobe ends at a right angle to its axis; the reference's does not.
            const Vec3d mirrored{-p.known[i].x, -p.known[i].y, p.known[i].z};
            if (m.kind == MaterialKind::Phong && m.phongExponent == 0 && dot(mirrored, p.next[i]) <= 1e-6) continue;
            const Vec3d expected = reference::evalBsdf(m, p.known[i], p.next[i]);
            const double pdf = reference::pdfBsdf(m, p.known[i], p.next[i]);
            double valueSlack = 1e-4 * maxComponent(expected), pdfSlack = 1e-4 * pdf;
            for (int k = 0; k < 12; ++k) {
                const Vec3d known = normalize(p.known[i] + randomDirection(random) * 4e-7),
                            next = normalize(p.next[i] + randomDirection(random) * 4e-7);
                valueSlack += std::abs(maxComponent(reference::evalBsdf(m, known, next)) - maxComponent(expected));
                pdfSlack += std::abs(reference::pdfBsdf(m, known, next) - pdf);
            }
            positive += pdf > 0;
            const Vec3d difference = values[i].value - expected;
            const double valueError =
                std::max({std::abs(difference.x), std::abs(difference.y), std::abs(difference.z)});
            const double pdfError = std::abs(values[i].pdf - pdf);
            // Fresnel's 1 − F near total reflection, and F where indices all but match, keep 2⁻²⁴ absolute, not
            // relative.
            wrongValue += valueError > valueSlack + 1e-6 / std::abs(p.next[i].z);
            wrongPdf += pdfError > pdfSlack + 1e-6;
        }
        const std::string difficulty = "narrow lobes, grazing and inside, against the host's reference";
        expectWithin({"Sampling", difficulty, "values that rounding does not explain", 0}, double(wrongValue),
                     device->info().name);
        expectWithin({"Sampling", difficulty, "densities that rounding does not explain", 0}, double(wrongPdf),
                     device->info().name);
        EXPECT_GT(positive, p.known.size() / 8);
    }
}

// f(a→b)/n_a² = f(b→a)/n_b² (Veach 1997, eq. 5.12), and the adjoint is the function with its directions exchanged.
TEST_F(BsdfValuesTest, AreReciprocal) {
    Random random(2);
    for (size_t index = 0; index < bsdfCases().size(); ++index) {
        const BsdfCase& c = bsdfCases()[index];
        SCOPED_TRACE(c.name);
        const Pairs p = pairs(index, 2000, random);
        const auto forward = bench.eval(index, p.known, p.next), backward = bench.eval(index, p.next, p.known);
        const auto adjoint = bench.eval(index, p.known, p.next, true);
        size_t wrongValue = 0, wrongAdjoint = 0, wrongPdf = 0, compared = 0;
        for (size_t i = 0; i < p.known.size(); ++i) {
            const auto indexOn = [&](const Vec3d& d) { return d.z < 0 ? c.indexBehind() : 1.0; };
            const double a2 = std::pow(indexOn(p.known[i]), 2), b2 = std::pow(indexOn(p.next[i]), 2);
            const double f = forward[i].value.y / a2, g = backward[i].value.y / b2, slack = 2 * tolerance(c),
                         rest = 1e-6 / std::abs(p.known[i].z * p.next[i].z);
            // A one-sided surface is black from behind, whichever way.
            if (!c.material.twoSided && (p.known[i].z < 0 || p.next[i].z < 0)) continue;
            if (std::max(f, g) < rest) continue;
            ++compared;
            wrongValue += std::abs(f - g) > slack * std::max(f, g) + rest;
            wrongAdjoint += std::abs(adjoint[i].value.y - backward[i].value.y) > slack * adjoint[i].value.y + rest;
            wrongPdf += std::abs(forward[i].reversePdf - backward[i].pdf) > slack * backward[i].pdf + rest;
        }
        EXPECT_GT(compared, p.known.size() / 8);
        // Tangential pairs within rounding of a horizon or of the critical angle may differ.
        const auto expectRare = [&](const std::string& what, size_t count) {
            expectWithin(
                {"Sampling", "directions exchanged, adjoint transport", "share of " + what + " that differ", 0.002},
                double(count) / double(compared), device->info().name);
        };
        expectRare("values", wrongValue);
        expectRare("adjoint values", wrongAdjoint);
        expectRare("reverse densities", wrongPdf);
    }
}

TEST_F(BsdfValuesTest, EndsOfTheRandomNumbersAreFine) {
    const float ends[] = {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
    std::vector<Texel> u;
    for (float x : ends)
        for (float y : ends)
            for (float z : ends)
                for (float w : ends) u.push_back({x, y, z, w});
    BsdfBench specular(*device, specularCases());
    size_t wrong = 0;
    for (const bool smooth : {false, true})
        for (size_t index = 0; index < (smooth ? specularCases() : bsdfCases()).size(); ++index)
            for (double cosine : {1.0, 0.999999, 0.5, 1e-3, 1e-6, -1.0, -0.7, -0.3, -1e-6})
                for (bool adjoint : {false, true}) {
                    SCOPED_TRACE((smooth ? specularCases() : bsdfCases())[index].name + ", cosine " +
                                 std::to_string(cosine));
                    BsdfBench& on = smooth ? specular : bench;
                    for (const DrawnBsdf& d : on.sample(index, on.rounded(atCosine(cosine)), u, adjoint)) {
                        EXPECT_FALSE(d.zeroPdf);
                        wrong += d.zeroPdf;
                        if (!d.valid) continue;
                        const bool sound = isFinite(d.direction) && isFinite(d.value) && std::isfinite(d.reversePdf) &&
                                           d.pdf > 0 && std::isfinite(d.pdf) &&
                                           std::abs(length(d.direction) - 1) < 1e-6 &&
                                           std::min({d.value.x, d.value.y, d.value.z, d.reversePdf}) >= 0;
                        EXPECT_TRUE(sound);
                        wrong += !sound;
                    }
                }
    expectWithin({"Sampling", "random numbers of exactly 0 and 1 − 2⁻²⁴, every material, cosines to 10⁻⁶",
                  "draws not finite, not unit, negative or without density", 0},
                 double(wrong), device->info().name);
}

// Null hypothesis: a white metal reflects all that arrives, to the .001 of the tables, as a conductor and as glTF's
// metal. Significance 0.01 over all cases (Šidák).
TEST_F(BsdfValuesTest, RoughMetalKeepsItsEnergy) {
    Random random(3);
    std::vector<BsdfCase> cases;
    for (double roughness : {0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.0})
        for (const bool conductor : {true, false}) {
            BsdfCase c{"", Material{}, roughness * roughness};
            c.material.kind = conductor ? MaterialKind::RoughConductor : MaterialKind::MetallicRoughness;
            c.material.roughness = float(roughness);
            // Reflects everything at every angle.
            c.material.conductorEta = Vec3f(0.0f);
            c.material.conductorK = Vec3f(1.0f);
            c.material.baseColor = Vec3f(1.0f);
            c.material.metallic = 1;
            cases.push_back(c);
        }
    BsdfBench white(*device, cases);
    const double cosines[] = {1.0, 0.7, 0.4, 0.1, 0.02};
    const double significance = sidak(0.01, cases.size() * std::size(cosines));
    for (size_t index = 0; index < cases.size(); ++index)
        for (double mu : cosines) {
            Moments albedo;
            for (const DrawnBsdf& d : white.sample(index, white.rounded(atCosine(mu)), uniformTexels(50000, random)))
                albedo.add(d.valid ? d.value.x * d.direction.z / d.pdf : 0);
            const double error = std::max(0.0, std::abs(albedo.mean() - 1) - 0.001);
            SCOPED_TRACE(testing::Message() << "α " << cases[index].lobeWidth << ", μ " << mu << ": " << albedo.mean());
            expectWithin({"Closed forms", "energy that white rough metal keeps, roughness from .1, at grazing angles",
                          "largest −log₁₀ p of z-tests", -std::log10(significance)},
                         -std::log10(normalTwoSidedP(error / std::sqrt(albedo.meanVariance()))), device->info().name);
        }
}

// Null hypothesis: what rough glass reflects and passes is all that arrives, from outside and from inside, as a body of
// its own, as glTF's, and as a pane, to the .005 of the tables, which have no room for the angle of total reflection.
// Significance 0.01 over all cases (Šidák).
TEST_F(BsdfValuesTest, RoughGlassKeepsItsEnergy) {
    Random random(5);
    std::vector<BsdfCase> cases;
    for (double roughness : {0.1, 0.3, 0.6, 1.0})
        for (float ior : {1.33f, 1.5f, 2.0f})
            for (const bool thin : {false, true}) {
                BsdfCase c{"", Material{}, roughness * roughness};
                c.material.kind = ior == 1.5f ? MaterialKind::MetallicRoughness : MaterialKind::RoughDielectric;
                c.material.transmission = 1;
                c.material.roughness = float(roughness);
                c.material.ior = ior;
                c.material.thin = thin;
                c.material.baseColor = Vec3f(1.0f);
                cases.push_back(c);
            }
    BsdfBench clear(*device, cases);
    const double cosines[] = {1.0, 0.6, 0.2, 0.03, -1.0, -0.7, -0.3};
    const double significance = sidak(0.01, cases.size() * std::size(cosines));
    for (size_t index = 0; index < cases.size(); ++index)
        for (double mu : cosines) {
            Moments albedo;
            const auto drawn = clear.sample(index, clear.rounded(atCosine(mu)), uniformTexels(20000, random), true);
            for (const DrawnBsdf& d : drawn) albedo.add(d.valid ? d.value.x * std::abs(d.direction.z) / d.pdf : 0);
            const double error = std::max(0.0, std::abs(albedo.mean() - 1) - 0.005);
            SCOPED_TRACE(testing::Message()
                         << "α " << cases[index].lobeWidth << ", index " << cases[index].material.ior
                         << (cases[index].material.thin ? ", pane" : "") << ", μ " << mu << ": " << albedo.mean());
            expectWithin({"Closed forms", "energy that rough glass keeps, roughness from .1, from outside and inside",
                          "largest −log₁₀ p of z-tests", -std::log10(significance)},
                         -std::log10(normalTwoSidedP(error / std::sqrt(albedo.meanVariance()))), device->info().name);
        }
}

// Null hypotheses: a white matte base under a clear coat reflects all that arrives, to the .001 of the tables; black
// under white sheen reflects what the table says; and nothing under either, or both, reflects more than arrives, to the
// same .001 (one-sided). Significance 0.01 over all cases (Šidák).
TEST_F(BsdfValuesTest, LayersKeepOrLoseEnergyAndGainNone) {
    Random random(7);
    std::vector<BsdfCase> cases;
    const auto add = [&](float base, float metallic, float specular, float coat, float coatRoughness, float sheen,
                         float sheenRoughness) {
        BsdfCase c{"", Material{}};
        c.material.kind = MaterialKind::MetallicRoughness;
        c.material.baseColor = Vec3f(base);
        c.material.metallic = metallic;
        c.material.roughness = 0.3f;
        c.material.specularFactor = specular;
        c.material.clearcoat = coat;
        c.material.clearcoatRoughness = coatRoughness;
        c.material.sheenColor = Vec3f(sheen);
        c.material.sheenRoughness = sheenRoughness;
        cases.push_back(c);
    };
    for (float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
        for (float coat : {0.5f, 1.0f}) add(1, 0, 0, coat, roughness, 0, 0);
        add(0, 0, 0, 0, 0, 1, roughness);
        add(1, 0, 1, 1, roughness, 0, 0);
        add(1, 1, 1, 1, roughness, 0, 0);
        add(1, 0, 0, 0, 0, 1, roughness);
        add(1, 0.5f, 1, 0.7f, 0.4f, 0.8f, roughness);
    }
    BsdfBench layered(*device, cases);
    const double cosines[] = {1.0, 0.7, 0.4, 0.1, 0.03};
    const double significance = sidak(0.01, cases.size() * std::size(cosines));
    for (size_t index = 0; index < cases.size(); ++index)
        for (double mu : cosines) {
            const Material& m = cases[index].material;
            const bool matte = m.metallic == 0 && m.specularFactor == 0, coated = matte && m.clearcoat > 0,
                       fibres = matte && m.baseColor.x == 0;
            Moments albedo;
            for (const DrawnBsdf& d :
                 layered.sample(index, layered.rounded(atCosine(mu)), uniformTexels(40000, random)))
                albedo.add(d.valid ? d.value.x * d.direction.z / d.pdf : 0);
            const double expected =
                fibres ? tabulatedSheenAlbedo(mu, std::max(double(m.sheenRoughness), leastSheenRoughness)) : 1;
            const double excess = albedo.mean() - expected,
                         error = coated || fibres ? std::abs(excess) : std::max(excess, 0.0);
            SCOPED_TRACE(testing::Message()
                         << "base " << m.baseColor.x << ", metallic " << m.metallic << ", coat " << m.clearcoat
                         << " of " << m.clearcoatRoughness << ", sheen " << m.sheenColor.x << " of " << m.sheenRoughness
                         << ", μ " << mu << ": " << albedo.mean() << " for " << expected);
            expectWithin({"Closed forms", "energy that clear coats and sheen keep, over matte, paint and metal",
                          "largest −log₁₀ p of z-tests", -std::log10(significance)},
                         -std::log10(normalTwoSidedP(std::max(0.0, error - 0.001) / std::sqrt(albedo.meanVariance()))),
                         device->info().name);
        }
}

// ---- Specular kinds --------------------------------------------------------------------------------------------

class SpecularTest : public DeviceTest {
protected:
    BsdfBench bench{*device, specularCases()};
};

// Null hypothesis: the share of reflected draws is Fresnel's. Significance 0.01 over all (Šidák).
TEST_F(SpecularTest, DirectionsCoefficientsAndFrequencies) {
    Random random(4);
    const double cosines[] = {1.0, 0.8, 0.3, 0.02, -1.0, -0.8, -0.5};
    const double significance = sidak(0.01, std::size(cosines) * 12);
    for (size_t index = 0; index < specularCases().size(); ++index)
        for (double cosine : cosines)
            for (bool adjoint : {false, true}) {
                const Material& m = specularCases()[index].material;
                SCOPED_TRACE(specularCases()[index].name + ", cosine " + std::to_string(cosine) +
                             (adjoint ? ", adjoint" : ""));
                const Vec3d known = bench.rounded(atCosine(cosine)), mirrored{-known.x, -known.y, known.z};
                const double eta = cosine > 0 ? double(m.ior) : 1 / double(m.ior);
                const bool glass = m.transmits();
                const auto refracted = m.thin ? std::optional(-known) : reference::refract(known, double(m.ior));
                double reflected = 0, valid = 0;
                const auto drawn = bench.sample(index, known, uniformTexels(20000, random), adjoint);
                for (const DrawnBsdf& d : drawn) {
                    ASSERT_TRUE(d.specular);
                    if (!d.valid) continue;
                    ++valid;
                    ASSERT_EQ(d.pdf, 1.0);
                    const bool reflects = d.direction.z * cosine > 0;
                    reflected += reflects;
                    ASSERT_TRUE(reflects || (glass && refracted));
                    // Near the critical angle refraction enlarges the rounding of the incident direction by cosine over
                    // cosine.
                    const double stretch = reflects ? 1 : 1 + 1 / std::abs(refracted->z);
                    ASSERT_LE(length(d.direction - (reflects ? mirrored : *refracted)), 6e-7 * stretch);
                    if (glass) {
                        // Tinted glass: a pane by its colour, a face of a body by the colour's root.
                        Vec3d expected(reflects || adjoint || m.thin ? 1 : 1 / (eta * eta));
                        if (m.kind == MaterialKind::MetallicRoughness && !reflects)
                            expected = expected * (m.thin ? Vec3d(m.baseColor) : Vec3d(0.8, 0.5, 0.2));
                        ASSERT_LE(length(d.value - expected), 2e-6 * length(expected));
                    }
                }
                if (!glass) {
                    EXPECT_EQ(reflected, valid);
                    continue;
                }
                EXPECT_GT(valid, 0.97 * double(drawn.size()));
                const double face = reference::specularProbability(m, known, mirrored);
                const double fresnel = m.thin ? 2 * face / (1 + face) : face;
                if (fresnel == 0 || fresnel == 1) {
                    EXPECT_EQ(reflected, fresnel * valid);
                } else if (fresnel * valid > 20) {
                    const double z = (reflected - fresnel * valid) / std::sqrt(valid * fresnel * (1 - fresnel));
                    SCOPED_TRACE(testing::Message() << reflected / valid << " for " << fresnel);
                    expectWithin({"Closed forms", "Fresnel's shares of smooth glass, ior 1 to 2.4, total reflection",
                                  "largest −log₁₀ p of z-tests", -std::log10(significance)},
                                 -std::log10(normalTwoSidedP(z)), device->info().name);
                } else {
                    EXPECT_LE(reflected, 60);
                }
            }
}

}  // namespace
}  // namespace antipode
