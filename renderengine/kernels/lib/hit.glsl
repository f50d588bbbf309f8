// A sub-path at the surface that its ray met: what the scatter, connect and merge stages start from.
#ifndef ANTIPODE_HIT
#define ANTIPODE_HIT
#include "lib/mis.glsl"

struct SurfaceHit {
    Path path;  // densities as of arrival at the surface
    Surface surface;
    Bsdf bsdf;
    real3 back;  // unit, to where the sub-path came from
    bool valid;  // false: the ray met nothing
};

SurfaceHit loadSurfaceHit(uint slot) {
    SurfaceHit h;
    h.path = loadPath(slot);
    Record hit = fetchRecord(hits, slot);
    uint primitive = recordTag(hit);
    real3 at = recordVector(hit);  // t, b1, b2
    h.valid = primitive != NO_INDEX;
    h.back = -h.path.direction;
    h.surface = surfaceAt(h.valid ? primitive : 0u, at.y, at.z, h.path.origin + at.x * h.path.direction);
    h.bsdf = loadBsdf(h.surface, h.back);
    arrive(h.path, at.x, dot(h.back, h.bsdf.ng));
    return h;
}
#endif
