// Metals of complex index, smooth (a delta lobe) and rough (GGX, with a lobe of multiple scattering).
#ifndef ANTIPODE_CONDUCTOR
#define ANTIPODE_CONDUCTOR
#include "lib/lobes/lambert.glsl"
#include "lib/lobes/mirror.glsl"
#include "lib/lobes/multiple_scattering.glsl"

void loadConductor(inout Bsdf b, uint material) {
    b.conductorEta = uintBitsToFloat(texelFetch(materials, int(material + 5u)).xyz);
    b.conductorK = uintBitsToFloat(texelFetch(materials, int(material + 6u)).xyz);
}

void sampleSmoothConductor(inout BsdfSample result, Bsdf b, real cosKnown) {
    result.value = fresnelConductor(abs(cosKnown), b.conductorEta, b.conductorK);
}

real3 sampleRoughConductor(real3 wKnown, real3 h) { return reflectAbout(wKnown, h); }

/// The chance of the lobe of multiple scattering, by the albedos, for a direction of which single scattering loses
/// this.
real conductorMultipleChance(Bsdf b, real loss) {
    real multiple = multipleAlbedo(b, loss), single = max(b.glossy.x, max(b.glossy.y, b.glossy.z)) * (1.0 - loss);
    return multiple / (multiple + single);
}

/// Whether `choice` in [0,1) takes single scattering, and not what is drawn as a Lambertian lobe.
bool samplesConductorGlossy(Bsdf b, real choice) {
    return !lobe(LOBE_MULTIPLE_SCATTERING) || choice >= conductorMultipleChance(b, b.lossKnown);
}

void addRoughConductor(inout LobeSum sum, Bsdf b, Microfacets m) {
    sum.value += fresnelConductor(m.cosHalf, b.conductorEta, b.conductorK) * m.value;
    real chance = 0.0, reverseChance = 0.0;
    if (lobe(LOBE_MULTIPLE_SCATTERING)) {
        real lossNew = metalLoss(m.cosNew, b.alpha);
        chance = conductorMultipleChance(b, b.lossKnown);
        reverseChance = conductorMultipleChance(b, lossNew);
        addMultipleScattering(sum, b, lossNew);
        addLambertPdf(sum, chance, reverseChance, m.cosKnown, m.cosNew);
    }
    sum.pdf += microfacetPdf(m, 1.0 - chance);
    sum.reversePdf += microfacetReversePdf(m, 1.0 - reverseChance);
}
#endif
