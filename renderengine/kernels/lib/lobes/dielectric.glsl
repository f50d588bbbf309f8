// A smooth interface between dielectrics, or a pane: two delta lobes, chosen by their reflectance.
#ifndef ANTIPODE_DIELECTRIC
#define ANTIPODE_DIELECTRIC
#include "lib/lobes/mirror.glsl"

/// `choice` in [0,1) decides between the reflected direction, which `r` holds, and the refracted one. Radiance scales
/// with the square of the index, light (`adjoint`) does not.
void sampleDielectric(inout BsdfSample result, Bsdf b, real3 wKnown, real cosKnown, bool adjoint, real choice) {
    real f = glassReflectance(b, abs(cosKnown));
    result.value = real3(1.0);
    if (choice >= f) {
        result.direction = isPane(b) ? -wKnown : refractAbout(wKnown, b.n, cosKnown, b.eta);
        if (!adjoint) result.value /= crossedIndex(b) * crossedIndex(b);
        if (lobe(LOBE_TRANSMISSION)) result.value *= b.tint;
    }
}
#endif
