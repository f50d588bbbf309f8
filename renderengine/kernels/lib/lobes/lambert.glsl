// The Lambertian lobe, also of Phong's and the metallic-roughness model.
#ifndef ANTIPODE_LAMBERT
#define ANTIPODE_LAMBERT
#include "lib/lobes/lobe.glsl"

real3 sampleLambert(Bsdf b, real2 u) { return toWorld(sampleCosineHemisphere(u), b.n); }

/// chance, reverseChance: of sampling this lobe from either direction.
void addLambertPdf(inout LobeSum sum, real chance, real reverseChance, real cosKnown, real cosNew) {
    sum.pdf += chance * cosNew / PI;
    sum.reversePdf += reverseChance * cosKnown / PI;
}

/// `scale`: what the layers above let through.
void addLambert(inout LobeSum sum, Bsdf b, real3 scale, real chance, real reverseChance, real cosKnown, real cosNew) {
    sum.value += b.diffuse * scale / PI;
    addLambertPdf(sum, chance, reverseChance, cosKnown, cosNew);
}
#endif
