#version 460
#extension GL_GOOGLE_include_directive : require
// A camera path at a surface: what the emitter that it met gives, a next-event sample, and the way on.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/hit.glsl"
#include "lib/light.glsl"

/// Radiance of a path that reached an emitter, weighted (eq. 42, 43). pdfNextEvent and pdfEmit are P_dir and P_emit.
real3 emitterHit(Path path, uint edges, real3 value, real pdfNextEvent, real pdfEmit) {
    if (!wantedLength(edges) || !wantedTechnique(0u, edges + 1u)) return real3(0.0);
    real w = edges == 1u ? 1.0 : misWeight(0.0, push.nextEventCount * pdfNextEvent * path.dVCM + pdfEmit * path.dVC);
    if (term(TERM_FIRST_DIFFUSE)) w = (path.flags & PATH_SPECULAR) != 0u ? 1.0 : 0.0;
    return path.throughput * value * w;
}

void main() {
    uint index = interleavedIndex();
    bool queued = index < liveCount();
    uint slot = queued ? queueEntry(index) : 0u;
    uint id = push.pathBase + slot;
    SurfaceHit h = loadSurfaceHit(slot);
    bool live = queued && h.valid;
    uint edges = pathLength(h.path);
    real endCount = cameraEndCount(edges);
    real3 sum = real3(0.0);

    if (term(TERM_HIT)) {
        if (feature(FEATURE_ENVIRONMENT)) {
            if (queued && !h.valid) {
                Path atInfinity = loadPath(slot);  // densities before arrival: in solid angle
                real radius = job.sceneCenter.w, pdf;
                real3 value = evalEnvironment(atInfinity.direction, pdf);
                real q = job.environment.w;
                sum += emitterHit(atInfinity, edges, value, q * pdf, q * pdf / (PI * radius * radius));
            }
        }
        if (feature(FEATURE_LIGHT_TRIANGLES | FEATURE_LIGHT_SPHERES)) {
            if (live && h.surface.light != NO_INDEX) {
                real c = dot(h.back, h.surface.normal);
                bool both = emitsBothSides(h.surface.material);
                real q = uintBitsToFloat(texelFetch(lights, int(h.surface.light * LIGHT_TEXELS)).w);
                real pdfArea = q / emitterArea(h.surface.primitive);
                if (c > 0.0 || both)
                    sum += emitterHit(h.path, edges, emittedRadiance(h.surface.material, h.surface.uv), pdfArea,
                                      pdfArea * abs(c) / PI * (both ? 0.5 : 1.0));
            }
        }
    }
    if (term(TERM_HIT)) {
        countInvalid(SOURCE_EMITTER_HIT, nonFinite(sum), any(lessThan(sum, real3(0.0))), false);
        if (queued && sum != real3(0.0)) radiance[slot] += real4(sum, 0.0);
    }

    bool scattering = live && !h.bsdf.black;
    if (term(TERM_NEXT_EVENT)) {
        real4 u = randomBlock(id, 0, edges, RANDOM_NEXT_EVENT);
        real2 more =
            feature(FEATURE_ENVIRONMENT_MAP) ? randomBlock(id, 0, edges, RANDOM_NEXT_EVENT_MORE).xy : real2(0.0);
        DirectLight d = sampleDirect(h.surface.position, u, more);
        real pdf, reversePdf;
        real3 f = evalBsdf(h.bsdf, h.back, d.direction, false, pdf, reversePdf);
        real cosShading = abs(dot(d.direction, h.bsdf.n)), cosGeometric = abs(dot(d.direction, h.bsdf.ng));
        // eq. 44, 45
        real w = misWeight(
            d.delta ? 0.0 : push.hitCount * pdf / d.pdf,
            d.emitRatio * cosGeometric * (push.mergeCount + endCount * h.path.dVCM + reversePdf * h.path.dVC));
        real3 value = h.path.throughput * f * d.value * (cosShading * w);
        bool wanted = scattering && wantedLength(edges + 1u) && wantedTechnique(1u, edges + 1u);
        bool sampled = wanted && d.valid;
        countInvalid(SOURCE_NEXT_EVENT, sampled && nonFinite(value), sampled && any(lessThan(value, real3(0.0))),
                     wanted && (d.pdf == 0.0 || isnan(d.pdf)));
        wanted = sampled && max(value.x, max(value.y, value.z)) > 0.0;
        if (wanted)
            storeShadowRay(slot, leaveSurface(h.surface, d.direction), h.surface.primitive, d.target, d.primitive,
                           value, 0u);
        enqueueShadowRay(wanted, 0u, slot);
    }

    BsdfSample s = sampleBsdf(h.bsdf, h.back, false, randomBlock(id, 0, edges, RANDOM_SCATTER));
    bool alive = scattering && s.valid && edges < job.lengths.y;
    if (term(TERM_FIRST_DIFFUSE)) alive = alive && s.specular;
    real3 factor = s.specular ? s.value : s.value * (abs(dot(s.direction, h.bsdf.n)) / s.pdf);
    scatterMis(h.path, h.bsdf, s, h.back, endCount);
    h.path.throughput *= factor;
    h.path.origin = leaveSurface(h.surface, s.direction);
    h.path.originPrimitive = h.surface.primitive;
    h.path.direction = s.direction;
    h.path.flags = (edges + 1u) | (s.specular ? h.path.flags & PATH_SPECULAR : 0u);
    countInvalid(SOURCE_CAMERA_SCATTER,
                 alive && (nonFinite(h.path.throughput) || nonFinite(s.direction) || isnan(h.path.dVCM + h.path.dVC)),
                 alive && any(lessThan(h.path.throughput, real3(0.0))), scattering && s.zeroPdf);
    alive = alive && max(h.path.throughput.x, max(h.path.throughput.y, h.path.throughput.z)) > 0.0;
    if (alive) storePath(slot, h.path);
    enqueuePath(alive, slot);
}
