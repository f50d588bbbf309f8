// A sub-path at the surface that its ray met: what the scatter, connect and merge stages start from.
#ifndef ANTIPODE_HIT
#define ANTIPODE_HIT
#include "lib/mis.glsl"

struct SurfaceHit {
    Path path;        // densities as of arrival at the surface
    Surface surface;
    Bsdf bsdf;
    real3 back;       // unit, to where the sub-path came from
    bool valid;       // false: the ray met nothing
};

SurfaceHit loadSurfaceHit(uint slot) {
    SurfaceHit h;
    h.path = loadPath(slot);
    uvec4 hit = texelFetch(hits, int(slot));
    h.valid = hit.w != NO_INDEX;
    h.back = -h.path.direction;
    real t = uintBitsToFloat(hit.x);
    h.surface = surfaceAt(h.valid ? hit.w : 0u, uintBitsToFloat(hit.y), uintBitsToFloat(hit.z), h.path.origin + t * h.path.direction);
    h.bsdf = loadBsdf(h.surface, h.back);
    arrive(h.path, t, dot(h.back, h.bsdf.ng));
    return h;
}
#endif
