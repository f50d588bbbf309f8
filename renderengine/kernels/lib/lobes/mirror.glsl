// A perfect mirror: a delta lobe.
#ifndef ANTIPODE_MIRROR
#define ANTIPODE_MIRROR
#include "lib/lobes/lobe.glsl"

void sampleMirror(inout BsdfSample r, Bsdf b, real3 wKnown) {
    r.value = b.glossy;
    r.direction = reflectAbout(wKnown, b.n);
    r.pdf = 1.0;
}
#endif
