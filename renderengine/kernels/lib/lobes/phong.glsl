// The modified Phong model's glossy lobe (Lafortune and Willems 1994), in the versine 1 − cosα: where the exponent is
// large, the cosine's rounding is as large as the lobe.
#ifndef ANTIPODE_PHONG
#define ANTIPODE_PHONG
#include "lib/lobes/lobe.glsl"

void loadPhong(inout Bsdf b, uint material) {
    b.diffuseChance = uintBitsToFloat(texelFetch(materials, int(material + 6u)).w);
}

real phongVersine(real3 mirrored, real3 w) {
    real3 d = w - mirrored;
    return 0.5 * dot(d, d);
}
/// cosαⁿ for versines below 1.
real phongPower(real versine, real exponent) { return exp(exponent * logOneMinus(versine)); }
/// 1 − (1 − u)^(1/(n+1)): distributed as (n+1)/(2π)·cosαⁿ wants it. Of 1 − u, as u may be 0 and the lobe's border is
/// not of it.
real samplePhongVersine(real u, real exponent) { return oneMinusExp(-log(1.0 - u) / (exponent + 1.0)); }

real3 samplePhong(Bsdf b, real3 wKnown, real2 u) {
    real versine = samplePhongVersine(u.x, b.exponent);
    real s = sqrt(versine * (2.0 - versine)), phi = 2.0 * PI * (u.y - 0.5);
    return toWorld(real3(s * cos(phi), s * sin(phi), 1.0 - versine), reflectAbout(wKnown, b.n));
}

void addPhong(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew) {
    real versine = phongVersine(reflectAbout(wKnown, b.n), wNew);
    if (versine < 1.0) {
        real power = phongPower(versine, b.exponent) * (0.5 / PI);
        sum.value += b.glossy * (power * (b.exponent + 2.0));
        real lobePdf = power * (b.exponent + 1.0) * (1.0 - b.diffuseChance);
        sum.pdf += lobePdf;
        sum.reversePdf += lobePdf;
    }
}
#endif
