// glTF's clear coat (KHR_materials_clearcoat): a layer of index 1.5 over all else, smooth or of GGX facets.
//
// With E the coat's albedo (lib/albedos.glsl), T = 1 − coat·E is what it leaves. What lies below is scaled by
// min(T(i), T(o)), which is reciprocal and keeps the sum below E(o) + T(o) whatever the base is. Of a diffuse base that
// would lose light: there the scale is T(i)T(o) over its mean (Kelemen and Szirmay-Kalos 2001), by which a white one
// reflects all, like the format's own 1 − F(o), which is not reciprocal.
#ifndef ANTIPODE_CLEARCOAT
#define ANTIPODE_CLEARCOAT
#include "lib/albedos.glsl"
#include "lib/lobes/lobe.glsl"

/// `layers`: the material's record of layers.
void loadClearcoat(inout Bsdf b, uint layers, TexturePoint point) {
    uvec4 values = texelFetch(materials, int(layers));
    b.coat = uintBitsToFloat(values.x);
    b.coatRoughness = uintBitsToFloat(values.y);
    if (feature(FEATURE_TEXTURES)) {
        if (values.z != NO_INDEX) b.coat *= sampleTexture(values.z, point).r;
        if (values.w != NO_INDEX) b.coatRoughness *= sampleTexture(values.w, point).g;
    }
}

/// As of the base: D(h) has to stay within float's range.
real clearcoatAlpha(Bsdf b) { return max(b.coatRoughness * b.coatRoughness, 2.5e-4); }

/// What the coat reflects of light from a direction of this cosine > 0.
real coatAlbedo(Bsdf b, real cosine) { return b.coat * clearcoatAlbedo(cosine, b.coatRoughness); }

/// What a diffuse base that a Schlick layer (f0, f90) covers is scaled by on top of min(T(i), T(o)), over what it is
/// scaled by without a coat, save for the mean: T(i)T(o)/mean is min(T(i), T(o)) times this.
real clearcoatDiffuseGain(Bsdf b, real cosKnown, real cosNew, real f0, real f90) {
    real2 means = b.coat * clearcoatMeanAlbedos(b.coatRoughness);
    // ∫(1 − F)T with F = f0 + (f90 − f0)(1 − cosine)⁵.
    real passed = (1.0 - f0) * (1.0 - means.x) - (f90 - f0) * (1.0 / real(21.0) - means.y);
    return passed > 0.0 ? (1.0 - min(coatAlbedo(b, cosKnown), coatAlbedo(b, cosNew))) / passed : 0.0;
}

/// The chance of the lobe, by the albedos. `below`: of what it covers, from the same direction.
real clearcoatChance(Bsdf b, real cosine, real below) {
    real albedo = coatAlbedo(b, cosine);
    return albedo > 0.0 ? albedo / (albedo + (1.0 - albedo) * below) : 0.0;
}

real3 sampleClearcoat(Bsdf b, real3 wKnown, real2 u) {
    return reflectAbout(wKnown, sampleVisibleNormal(wKnown, b.n, clearcoatAlpha(b), u));
}

/// Lays the coat over what `sum` holds.
void addClearcoat(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew, real cosKnown, real cosNew, real chance,
                  real reverseChance) {
    Microfacets m = reflectingMicrofacets(wKnown, wNew, cosKnown, cosNew, b.n, clearcoatAlpha(b));
    sum.value *= 1.0 - max(coatAlbedo(b, cosKnown), coatAlbedo(b, cosNew));
    sum.value += b.coat * fresnelDielectric(m.cosHalf, 1.5) * m.value;
    sum.pdf = sum.pdf * (1.0 - chance) + microfacetPdf(m, chance);
    sum.reversePdf = sum.reversePdf * (1.0 - reverseChance) + microfacetReversePdf(m, reverseChance);
}
#endif
