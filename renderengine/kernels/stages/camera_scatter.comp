#version 460
#extension GL_GOOGLE_include_directive : require
// A camera path at its vertex: what the emitter that it met gives, a next-event sample, and the way on.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/path_vertex.glsl"
#include "lib/light.glsl"
#include "lib/guides.glsl"

/// Radiance of a path that reached an emitter, weighted.
real3 emitterRadiance(Path path, EmitterHit hit) {
    uint edges = pathLength(path);
    if (!wantedLength(edges) || !wantedTechnique(0u, edges + 1u)) return real3(0.0);
    return path.throughput * hit.radiance * weightEmitterHit(path, hit.pdfNextEvent, hit.pdfEmit);
}

void main() {
    uint index = interleavedIndex();
    bool queued = index < liveCount();
    uint slot = queued ? queueEntry(index) : 0u;
    PathVertex v = loadPathVertex(slot, false);
    bool live = queued && v.valid;
    uint edges = pathLength(v.path);

    if (layer(LAYERS_GUIDES)) {
        if (live) addGuides(v, push.pathBase + slot);
    }

    // Emitter hit: technique s = 0.
    if (term(TERM_HIT)) {
        real3 sum = real3(0.0);
        if (feature(FEATURE_ENVIRONMENT)) {
            if (queued && !v.valid) {
                Path atInfinity = loadPath(slot);  // densities before arrival: in solid angle
                sum += emitterRadiance(atInfinity, hitEnvironment(atInfinity.direction));
            }
        }
        if (feature(FEATURES_AREA_LIGHT)) {
            if (live && v.surface.light != NO_INDEX) {
                EmitterHit hit = hitArea(v.surface, v.back);
                if (hit.valid) sum += emitterRadiance(v.path, hit);
            }
        }
        countInvalid(SOURCE_EMITTER_HIT, nonFinite(sum), any(lessThan(sum, real3(0.0))), false);
        if (queued && sum != real3(0.0))
            addRadiance(slot, LAYER_EMITTER_HIT, seenAtWavelength(sum, isDispersed(v.path)));
    }

    // Next event: technique s = 1.
    bool scattering = live && goesOn(v);
    if (term(TERM_NEXT_EVENT)) {
        uint id = framePixel(push.pathBase + slot);
        real4 u = randomChoiceAndPoint(id, 0, edges, RANDOM_NEXT_EVENT);
        real2 more =
            feature(FEATURE_ENVIRONMENT_MAP) ? randomBlock(id, 0, edges, RANDOM_NEXT_EVENT_MORE).xy : real2(0.0);
        DirectLight light = sampleDirect(v.position, u, more);
        real pdf, reversePdf;
        real3 f = evalVertex(v, light.direction, pdf, reversePdf);
        uint medium = mediumTowards(slot, v, light.direction);
        real lightDistance = distance(light.target, v.position);
        real w = weightNextEvent(v.path, light.delta, light.pdf, light.emitRatio,
                                 arrivalDensity(v, light.direction, medium, lightDistance),
                                 pdf * passChance(medium, lightDistance), reversePdf);
        real3 value = v.path.throughput * f * light.value * (scatterCosine(v, light.direction) * w);
        if (hasExtinction()) value *= transmittance(medium, lightDistance);
        bool wanted = scattering && wantedLength(edges + 1u) && wantedTechnique(1u, edges + 1u);
        bool sampled = wanted && light.valid;
        countInvalid(SOURCE_NEXT_EVENT, sampled && nonFinite(value), sampled && any(lessThan(value, real3(0.0))),
                     wanted && (light.pdf == 0.0 || isnan(light.pdf)));
        wanted = sampled && max(value.x, max(value.y, value.z)) > 0.0;
        if (feature(FEATURE_INTERFACES) && wanted) storeShadowMedium(slot, medium);
        if (wanted)
            storeShadowRay(slot, leaveVertex(v, light.direction), v.primitive, light.target, light.primitive,
                           seenAtWavelength(value, isDispersed(v)), 0u);
        enqueueShadowRay(wanted, 0u, slot);
    }

    // The way on.
    bool alive = continuePath(v, slot, job.lengths.y, scattering, SOURCE_CAMERA_SCATTER);
    enqueuePath(alive, slot);
}
