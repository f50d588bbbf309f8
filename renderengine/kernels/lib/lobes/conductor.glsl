// Metals of complex index, smooth (a delta lobe) and rough (GGX, single scattering).
#ifndef ANTIPODE_CONDUCTOR
#define ANTIPODE_CONDUCTOR
#include "lib/lobes/mirror.glsl"

void loadConductor(inout Bsdf b, uint material) {
    b.conductorEta = uintBitsToFloat(texelFetch(materials, int(material + 5u)).xyz);
    b.conductorK = uintBitsToFloat(texelFetch(materials, int(material + 6u)).xyz);
}

void sampleSmoothConductor(inout BsdfSample r, Bsdf b, real cosKnown) {
    r.value = fresnelConductor(abs(cosKnown), b.conductorEta, b.conductorK);
}

real3 sampleRoughConductor(real3 wKnown, real3 h) { return reflectAbout(wKnown, h); }

void addRoughConductor(inout LobeSum sum, Bsdf b, Microfacets m) {
    sum.value += fresnelConductor(m.cosHalf, b.conductorEta, b.conductorK) * m.value;
    sum.pdf += microfacetPdf(m, 1.0);
    sum.reversePdf += microfacetReversePdf(m, 1.0);
}
#endif
