// A rough interface between dielectrics (Walter et al. 2007): GGX microfacets that reflect and refract. A pane's pass
// light on as they would reflect it, mirrored at the surface: what one face bends the other bends back.
#ifndef ANTIPODE_ROUGH_DIELECTRIC
#define ANTIPODE_ROUGH_DIELECTRIC
#include "lib/lobes/lobe.glsl"

/// At a visible normal h; `choice` in [0,1) decides between reflection and refraction.
real3 sampleRoughDielectric(Bsdf b, real3 wKnown, real3 h, real choice, out bool transmitted) {
    real c = dot(wKnown, h);
    transmitted = choice >= glassReflectance(b, c);
    real3 reflected = reflectAbout(wKnown, h);
    if (isPane(b)) return transmitted ? reflectAbout(-reflected, b.n) : reflected;
    return transmitted ? refractAbout(wKnown, h, c, b.eta) : reflected;
}

void addRoughDielectricReflection(inout LobeSum sum, Bsdf b, Microfacets m) {
    real f = glassReflectance(b, m.cosHalf);
    if (feature(FEATURE_TRANSMISSION)) f *= b.glass;
    sum.value += real3(f) * m.value;
    sum.pdf += microfacetPdf(m, f);
    sum.reversePdf += microfacetReversePdf(m, f);
}

/// wNew on the other side of a pane.
void addRoughPane(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew) {
    real3 mirrored = -reflectAbout(wNew, b.n);
    Microfacets m = reflectingMicrofacets(wKnown, mirrored, dot(wKnown, b.n), -dot(wNew, b.n), b.n, b.alpha);
    real passed = (1.0 - glassReflectance(b, m.cosHalf)) * b.glass;
    sum.value += b.tint * (passed * m.value);
    sum.pdf += microfacetPdf(m, passed);
    sum.reversePdf += microfacetReversePdf(m, passed);
}

/// Walter et al. 2007, eq. 21 and 17; wNew on the other side.
void addRoughDielectricRefraction(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew, bool adjoint) {
    real cosKnown = dot(wKnown, b.n), cosNew = dot(wNew, b.n);
    real3 h = normalize(wKnown + wNew * b.eta);
    if (dot(h, b.n) < 0.0) h = -h;
    real ko = dot(wKnown, h), ki = dot(wNew, h);
    if (ko > 0.0 && ki < 0.0) {
        real f = fresnelDielectric(ko, b.eta);
        real d = ggxDistribution(h, b.n, b.alpha);
        real denominator = ki + ko / b.eta;
        denominator *= denominator;
        sum.value =
            real3((1.0 - f) * d * ggxG2(cosKnown, cosNew, b.alpha) * abs(ki * ko / (cosKnown * cosNew * denominator)));
        if (!adjoint) sum.value /= b.eta * b.eta;
        real reverse = ko + ki * b.eta;
        sum.pdf = (1.0 - f) * ggxG1(cosKnown, b.alpha) * ko * d / cosKnown * abs(ki) / denominator;
        sum.reversePdf = (1.0 - f) * ggxG1(cosNew, b.alpha) * abs(ki) * d / abs(cosNew) * ko / (reverse * reverse);
        if (feature(FEATURE_TRANSMISSION)) {
            scaleLobes(sum, b.glass);
            sum.value *= b.tint;
        }
    }
}
#endif
