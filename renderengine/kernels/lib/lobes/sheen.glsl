// glTF's sheen (KHR_materials_sheen): fibres that stand up from a surface, by the inverted Gaussian of Estevez and
// Kulla, "Production Friendly Microfacet Sheen BRDF", 2017, with their fit of its masking, height-correlated and
// without their softened terminator, which is not reciprocal.
//
// What lies below is scaled by min(1 − s·E(i), 1 − s·E(o)), as the format says: E is the albedo of white sheen
// (lib/albedos.glsl), s the greatest channel of its colour. That is reciprocal, and the sum reflects at most
// s·E(o) + 1 − s·E(o). E itself is above 1 at grazing angles for roughness below SHEEN_LEAST_ROUGHNESS, where the model
// ends.
#ifndef ANTIPODE_SHEEN
#define ANTIPODE_SHEEN
#include "lib/albedos.glsl"
#include "lib/lobes/lobe.glsl"

/// `layers`: the material's record of layers.
void loadSheen(inout Bsdf b, uint layers, TexturePoint point) {
    uvec4 values = texelFetch(materials, int(layers + 1u)), maps = texelFetch(materials, int(layers + 2u));
    b.sheen = uintBitsToFloat(values.xyz);
    b.sheenRoughness = uintBitsToFloat(values.w);
    if (feature(FEATURE_TEXTURES)) {
        if (maps.x != NO_INDEX) b.sheen *= sampleTexture(maps.x, point).rgb;
        if (maps.y != NO_INDEX) b.sheenRoughness *= sampleTexture(maps.y, point).a;
    }
    b.sheenRoughness = max(b.sheenRoughness, SHEEN_LEAST_ROUGHNESS);
}

/// The greatest channel of its albedo from a direction of this cosine > 0.
real sheenAlbedo(Bsdf b, real cosine) {
    real strength = max(b.sheen.x, max(b.sheen.y, b.sheen.z));
    return strength * whiteSheenAlbedo(cosine, b.sheenRoughness);
}

/// The exponent of the fitted Λ, for cosines below one half.
real sheenMaskingFit(real cosine, real alpha) {
    real s = (1.0 - alpha) * (1.0 - alpha);
    // Times 10⁵, which floats hold exactly.
    real a = mix(real(2154730.0), real(2532450.0), s), b = mix(real(382987.0), real(332435.0), s),
         c = mix(real(19823.0), real(16801.0), s), d = mix(real(-197760.0), real(-127393.0), s),
         e = mix(real(-432054.0), real(-485967.0), s);
    real power = cosine > 0.0 ? exp(c / 1e5 * log(cosine)) : 0.0;  // cosineᶜ
    return (a / (1.0 + b / 1e5 * power) + d * cosine + e) / 1e5;
}

real sheenLambda(real cosine, real alpha) {
    if (cosine < 0.5) return exp(sheenMaskingFit(cosine, alpha));
    return exp(2.0 * sheenMaskingFit(0.5, alpha) - sheenMaskingFit(max(1.0 - cosine, 0.0), alpha));
}

/// White sheen's BRDF. Where light grazes closer than the fit was made for, Λ times the cosine vanishes, and fibres
/// would give more than they get: there it is as at the least cosine.
real sheenValue(Bsdf b, real3 wKnown, real3 wNew, real cosKnown, real cosNew) {
    real alpha = b.sheenRoughness * b.sheenRoughness;
    // sin² of the half vector to the normal: by the cross product, as 1 − cos² loses it where it is small.
    real3 sine = cross(normalize(wKnown + wNew), b.n);
    real sine2 = dot(sine, sine);
    real distribution = sine2 > 0.0 ? (2.0 + 1.0 / alpha) * exp(0.5 / alpha * log(sine2)) / (2.0 * PI) : 0.0;
    const real leastCosine = 1e-4;
    real known = max(cosKnown, leastCosine), new_ = max(cosNew, leastCosine);
    return distribution / (4.0 * known * new_ * (1.0 + sheenLambda(known, alpha) + sheenLambda(new_, alpha)));
}

/// The chance of the lobe, by the albedos. `below`: of what it covers, from the same direction.
real sheenChance(Bsdf b, real cosine, real below) {
    real albedo = sheenAlbedo(b, cosine);
    return albedo > 0.0 ? albedo / (albedo + (1.0 - albedo) * below) : 0.0;
}

/// Uniform over the hemisphere; pdfSolidAngle = 1/(2π).
real3 sampleSheen(Bsdf b, real2 u) {
    real z = 1.0 - u.x, r = sqrt(u.x * (2.0 - u.x)), phi = 2.0 * PI * (u.y - 0.5);
    return toWorld(real3(r * cos(phi), r * sin(phi), z), b.n);
}

/// Lays the sheen over what `sum` holds.
void addSheen(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew, real cosKnown, real cosNew, real chance,
              real reverseChance) {
    sum.value *= 1.0 - max(sheenAlbedo(b, cosKnown), sheenAlbedo(b, cosNew));
    sum.value += b.sheen * sheenValue(b, wKnown, wNew, cosKnown, cosNew);
    sum.pdf = sum.pdf * (1.0 - chance) + chance / (2.0 * PI);
    sum.reversePdf = sum.reversePdf * (1.0 - reverseChance) + reverseChance / (2.0 * PI);
}
#endif
