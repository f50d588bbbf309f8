// A perfect mirror: a delta lobe.
#ifndef ANTIPODE_MIRROR
#define ANTIPODE_MIRROR
#include "lib/lobes/lobe.glsl"

void sampleMirror(inout BsdfSample result, Bsdf b, real3 wKnown) {
    result.value = b.glossy;
    result.direction = reflectAbout(wKnown, b.n);
    result.pdf = 1.0;
}
#endif
