// The state of paths between stages, and the queues of those that live.
#ifndef ANTIPODE_STATE
#define ANTIPODE_STATE
#include "lib/record.glsl"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(set = 0, binding = BIND_PATHS) uniform usamplerBuffer paths;
layout(set = 0, binding = BIND_PATHS_OUT, std430) writeonly buffer PathsOut { Record pathsOut[]; };
layout(set = 0, binding = BIND_HITS) uniform usamplerBuffer hits;
layout(set = 0, binding = BIND_HITS_OUT, std430) writeonly buffer HitsOut { Record hitsOut[]; };
layout(set = 0, binding = BIND_RADIANCE, std430) buffer Radiance { real4 radiance[]; };
layout(set = 0, binding = BIND_TECHNIQUE_RADIANCE, std430) buffer TechniqueRadiance { real4 techniqueRadiance[]; };
layout(set = 0, binding = BIND_SHADOW) uniform usamplerBuffer shadow;
layout(set = 0, binding = BIND_SHADOW_OUT, std430) writeonly buffer ShadowOut { Record shadowOut[]; };
layout(set = 0, binding = BIND_QUEUES) uniform usamplerBuffer queues;
layout(set = 0, binding = BIND_QUEUES_OUT, std430) writeonly buffer QueuesOut { uint queuesOut[]; };
layout(set = 0, binding = BIND_SLOT_FLAGS, std430) buffer SlotFlags { uint slotFlags[]; };

/// One end of a sub-path: the ray that leaves its last vertex.
/// dVCM, dVC: Georgiev, "Implementing Vertex Connection and Merging", 2012, eq. 31–36. His dVM is dVC/η at every vertex
/// once each technique is weighted by its sample count, and is not kept.
struct Path {
    real3 origin;
    uint originPrimitive;  // NO_INDEX for the camera, point lights and infinity
    real3 direction;
    uint flags;
    real3 throughput;
    real dVCM, dVC;
    real lossless;  // greatest channel of the throughput had nothing been absorbed: roulette goes by what is left of it
};

uint pathLength(Path path) { return path.flags & PATH_LENGTH_MASK; }

/// Whether dVC can be anything but 0: it stands for techniques that end on light vertices, which path tracing has none
/// of.
bool hasLightPaths() { return term(TERM_SPLAT | TERM_CONNECT | TERM_MERGE); }

/// Whether a path's fourth record holds anything. Without light paths and refraction dVC is 0 and `lossless` is 1.
bool hasPathRest() { return hasLightPaths() || (term(TERM_ROULETTE) && lobe(LOBE_DIELECTRIC | LOBE_ROUGH_DIELECTRIC)); }

// Records of a path: origin, its primitive; direction, flags; throughput, dVCM; dVC, lossless.
Path loadPath(uint slot) {
    uint at = slot * PATH_RECORDS;
    Record origin = fetchRecord(paths, at), direction = fetchRecord(paths, at + 1u),
           throughput = fetchRecord(paths, at + 2u);
    real3 rest = hasPathRest() ? recordVector(fetchRecord(paths, at + 3u)) : real3(0.0, 1.0, 0.0);
    return Path(recordVector(origin), recordTag(origin), recordVector(direction), recordTag(direction),
                recordVector(throughput), recordFourth(throughput), rest.x, rest.y);
}

void storePath(uint slot, Path path) {
    uint at = slot * PATH_RECORDS;
    pathsOut[at] = packRecord(path.origin, path.originPrimitive);
    pathsOut[at + 1u] = packRecord(path.direction, path.flags);
    pathsOut[at + 2u] = packRecord(real4(path.throughput, path.dVCM));
    if (hasPathRest()) pathsOut[at + 3u] = packRecord(real3(path.dVC, path.lossless, 0.0), 0u);
}

/// Adds to the radiance of the slot's camera path what one of its techniques found (its LAYER_* bit).
void addRadiance(uint slot, uint technique, real3 value) {
    radiance[slot] += real4(value, 0.0);
    if (layer(LAYERS_OF_CAMERA_TECHNIQUES))
        techniqueRadiance[uint(findLSB(technique)) * push.batchSize + slot] += real4(value, 0.0);
}

/// Adds to what the merges of the slot's camera path found by all of the disk more than by the inner half of its area
/// alone, which is summed beside the radiance: two estimates of one density from the same light vertices, of different
/// bias (film/bias_estimate.h).
void addBlur(uint slot, real3 difference) { radiance[slot].w += luminance(difference); }

void clearRadiance(uint slot) {
    radiance[slot] = real4(0.0);
    if (layer(LAYERS_OF_CAMERA_TECHNIQUES))
        for (uint t = 0u; t < CAMERA_TECHNIQUES; ++t) techniqueRadiance[t * push.batchSize + slot] = real4(0.0);
}

uint liveCount() { return counters[COUNTER_QUEUE + push.queueParity]; }
uint queueEntry(uint index) { return texelFetch(queues, int(push.queueParity * push.batchSize + index)).x; }

/// A segment whose visibility decides whether `value` counts: for the path's own radiance, or as a splat for `pixel`.
/// Both ends lie off their surfaces by the error bound.
void storeShadowRay(uint slot, real3 origin, uint originPrimitive, real3 target, uint targetPrimitive, real3 value,
                    uint pixel) {
    uint at = slot * SHADOW_RECORDS;
    shadowOut[at] = packRecord(origin, originPrimitive);
    shadowOut[at + 1u] = packRecord(target - origin, targetPrimitive);
    shadowOut[at + 2u] = packRecord(value, pixel);
}

/// Appends to the counter's queue the slots of the invocations that want it: one atomic a subgroup.
uint appendTo(uint counter, bool wanted) {
    uvec4 ballot = subgroupBallot(wanted);
    uint count = subgroupBallotBitCount(ballot);
    uint base = 0u;
    if (subgroupElect() && count > 0u) base = atomicAdd(counters[counter], count);
    return subgroupBroadcastFirst(base) + subgroupBallotExclusiveBitCount(ballot);
}

/// The order of a shadow queue does not matter: each path has at most one entry, and what an entry adds is either its
/// own path's or an integer sum.
void enqueueShadowRay(bool wanted, uint index, uint slot) {
    uint at = appendTo(COUNTER_SHADOW_QUEUE + index, wanted);
    if (wanted) queuesOut[2u * push.batchSize + at] = slot;
}

/// Lets the path go on in the next wave, in any order: for paths that store no light vertices.
void enqueuePath(bool wanted, uint slot) {
    uint at = appendTo(COUNTER_QUEUE + 1u - push.queueParity, wanted);
    if (wanted) queuesOut[(1u - push.queueParity) * push.batchSize + at] = slot;
}
#endif
