// A rough interface between dielectrics (Walter et al. 2007): GGX microfacets that reflect and refract. A pane's pass
// light on as they would reflect it, mirrored at the surface: what one face bends the other bends back.
//
// What single scattering loses, L = 1 − E, leaves after more of it (Kulla and Conty 2017): of light from o the part a
// to its own side, as a·L(o)L(i)/(πL̄), and t = 1 − a beyond, as t·L(o)L'(i)/(πL̄'), L' being the loss of the other side.
// Both ways are one function, as n² asks, where t'·n'²L̄' = t·n²L̄: t is T·L̄'/max(L̄, L̄'), T being what smooth glass
// passes of uniform light, of which n²T is the same from both sides.
#ifndef ANTIPODE_ROUGH_DIELECTRIC
#define ANTIPODE_ROUGH_DIELECTRIC
#include "lib/lobes/lambert.glsl"

/// What a smooth interface passes of uniform light from the side of the lower index; `index` ≥ 1 (Kulla and Conty's
/// fit).
real meanTransmittance(real index) { return 1.0 - (index - 1.0) / (4.08567 + 1.00071 * index); }

void loadRoughDielectric(inout Bsdf b, real cosKnown) {
    real c = max(cosKnown, 0.0), passed = meanTransmittance(max(b.eta, 1.0 / b.eta));
    if (isPane(b)) {
        b.glassLoss = metalLoss(c, b.alpha);
        b.glassMeanLoss = real2(metalMeanLoss(b.alpha));
        b.glassPassed = real2(passed / (2.0 - passed));
    } else {
        b.glassLoss = glassLoss(c, b.alpha, b.eta);
        b.glassMeanLoss = glassMeanLosses(b.alpha, b.eta);
        real2 index2 = min(real2(1.0), real2(b.eta * b.eta, 1.0 / (b.eta * b.eta)));
        b.glassPassed = passed * index2 * b.glassMeanLoss.yx / max(b.glassMeanLoss.x, b.glassMeanLoss.y);
    }
}

/// Whether `choice` in [0,1) takes what is scattered more than once, by its albedo, and if so beyond the interface;
/// what is left of `choice` is returned in it.
bool samplesGlassMultiple(Bsdf b, inout real choice, out bool transmitted) {
    bool multiple = choice < b.glassLoss;
    choice = multiple ? choice / b.glassLoss : (choice - b.glassLoss) / (1.0 - b.glassLoss);
    choice = min(choice, 1.0 - UNIT_ROUNDOFF);
    transmitted = multiple && choice < b.glassPassed.x;
    return multiple;
}

/// At a visible normal h; `choice` in [0,1) decides between reflection and refraction.
real3 sampleRoughDielectric(Bsdf b, real3 wKnown, real3 h, real choice, out bool transmitted) {
    real c = dot(wKnown, h);
    transmitted = choice >= glassReflectance(b, c);
    real3 reflected = reflectAbout(wKnown, h);
    if (isPane(b)) return transmitted ? reflectAbout(-reflected, b.n) : reflected;
    return transmitted ? refractAbout(wKnown, h, c, b.eta) : reflected;
}

/// Adds what glass scatters, where it is part of the surface only by its share.
void addGlass(inout LobeSum sum, Bsdf b, LobeSum glass) {
    if (lobe(LOBE_TRANSMISSION)) scaleLobes(glass, b.glass);
    sum.value += glass.value;
    sum.pdf += glass.pdf;
    sum.reversePdf += glass.reversePdf;
}

void addRoughDielectricReflection(inout LobeSum sum, Bsdf b, Microfacets m) {
    real f = glassReflectance(b, m.cosHalf);
    real lossNew = isPane(b) ? metalLoss(m.cosNew, b.alpha) : glassLoss(m.cosNew, b.alpha, b.eta);
    real back = 1.0 - b.glassPassed.x;
    LobeSum glass;
    glass.value = real3(f * m.value + back * b.glassLoss * lossNew / (PI * b.glassMeanLoss.x));
    glass.pdf = microfacetPdf(m, f * (1.0 - b.glassLoss));
    glass.reversePdf = microfacetReversePdf(m, f * (1.0 - lossNew));
    addLambertPdf(glass, back * b.glassLoss, back * lossNew, m.cosKnown, m.cosNew);
    addGlass(sum, b, glass);
}

/// What leaves beyond after more than one scattering, before it is tinted, as light travels. lossNew: of wNew, there.
void addGlassPassed(inout LobeSum glass, Bsdf b, real lossNew, real cosKnown, real cosNew) {
    glass.value += real3(b.glassPassed.x * b.glassLoss * lossNew / (PI * b.glassMeanLoss.y));
    addLambertPdf(glass, b.glassPassed.x * b.glassLoss, b.glassPassed.y * lossNew, cosKnown, cosNew);
}

/// wNew on the other side of a pane.
void addRoughPane(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew) {
    real3 mirrored = -reflectAbout(wNew, b.n);
    Microfacets m = reflectingMicrofacets(wKnown, mirrored, dot(wKnown, b.n), -dot(wNew, b.n), b.n, b.alpha);
    real passed = 1.0 - glassReflectance(b, m.cosHalf), lossNew = metalLoss(m.cosNew, b.alpha);
    LobeSum glass;
    glass.value = real3(passed * m.value);
    glass.pdf = microfacetPdf(m, passed * (1.0 - b.glassLoss));
    glass.reversePdf = microfacetReversePdf(m, passed * (1.0 - lossNew));
    addGlassPassed(glass, b, lossNew, m.cosKnown, m.cosNew);
    glass.value *= b.tint;
    addGlass(sum, b, glass);
}

/// Walter et al. 2007, eq. 21 and 17; wNew on the other side.
void addRoughDielectricRefraction(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew, bool adjoint) {
    real cosKnown = dot(wKnown, b.n), cosNew = dot(wNew, b.n);
    real lossNew = glassLoss(-cosNew, b.alpha, 1.0 / b.eta);
    LobeSum glass = LobeSum(real3(0.0), 0.0, 0.0);
    real3 h = normalize(wKnown + wNew * b.eta);
    if (dot(h, b.n) < 0.0) h = -h;
    real ko = dot(wKnown, h), ki = dot(wNew, h);
    if (ko > 0.0 && ki < 0.0) {
        real f = fresnelDielectric(ko, b.eta);
        real d = ggxDistribution(h, b.n, b.alpha);
        real denominator = ki + ko / b.eta;
        denominator *= denominator;
        glass.value =
            real3((1.0 - f) * d * ggxG2(cosKnown, cosNew, b.alpha) * abs(ki * ko / (cosKnown * cosNew * denominator)));
        real reverse = ko + ki * b.eta;
        glass.pdf = (1.0 - f) * ggxG1(cosKnown, b.alpha) * ko * d / cosKnown * abs(ki) / denominator;
        glass.reversePdf = (1.0 - f) * ggxG1(cosNew, b.alpha) * abs(ki) * d / abs(cosNew) * ko / (reverse * reverse);
        glass.pdf *= 1.0 - b.glassLoss;
        glass.reversePdf *= 1.0 - lossNew;
    }
    addGlassPassed(glass, b, lossNew, cosKnown, -cosNew);
    if (!adjoint) glass.value /= b.eta * b.eta;
    if (lobe(LOBE_TRANSMISSION)) glass.value *= b.tint;
    addGlass(sum, b, glass);
}
#endif
