// The state of paths between stages, and the queues of those that live.
#ifndef ANTIPODE_STATE
#define ANTIPODE_STATE
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(set = 0, binding = BIND_PATHS) uniform usamplerBuffer paths;
layout(set = 0, binding = BIND_PATHS_OUT, std430) writeonly buffer PathsOut { uvec4 pathsOut[]; };
layout(set = 0, binding = BIND_HITS) uniform usamplerBuffer hits;
layout(set = 0, binding = BIND_HITS_OUT, std430) writeonly buffer HitsOut { uvec4 hitsOut[]; };
layout(set = 0, binding = BIND_RADIANCE, std430) buffer Radiance { vec4 radiance[]; };
layout(set = 0, binding = BIND_SHADOW) uniform usamplerBuffer shadow;
layout(set = 0, binding = BIND_SHADOW_OUT, std430) writeonly buffer ShadowOut { uvec4 shadowOut[]; };
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
};

uint pathLength(Path path) { return path.flags & PATH_LENGTH_MASK; }

/// Whether dVC can be anything but 0: it stands for techniques that end on light vertices, which path tracing has none of.
bool hasLightPaths() { return term(TERM_SPLAT | TERM_CONNECT | TERM_MERGE); }

// Texels of a path: origin, its primitive; direction, flags; throughput, dVCM; dVC.
Path loadPath(uint slot) {
    int at = int(slot * PATH_TEXELS);
    uvec4 origin = texelFetch(paths, at), direction = texelFetch(paths, at + 1), throughput = texelFetch(paths, at + 2);
    uint dVC = hasLightPaths() ? texelFetch(paths, at + 3).x : 0u;
    return Path(uintBitsToFloat(origin.xyz), origin.w, uintBitsToFloat(direction.xyz), direction.w,
                uintBitsToFloat(throughput.xyz), uintBitsToFloat(throughput.w), uintBitsToFloat(dVC));
}

void storePath(uint slot, Path path) {
    uint at = slot * PATH_TEXELS;
    pathsOut[at] = uvec4(floatBitsToUint(path.origin), path.originPrimitive);
    pathsOut[at + 1u] = uvec4(floatBitsToUint(path.direction), path.flags);
    pathsOut[at + 2u] = uvec4(floatBitsToUint(path.throughput), floatBitsToUint(path.dVCM));
    if (hasLightPaths()) pathsOut[at + 3u].x = floatBitsToUint(path.dVC);
}

uint liveCount() { return counters[COUNTER_QUEUE + push.queueParity]; }
uint queueEntry(uint index) { return texelFetch(queues, int(push.queueParity * push.batchSize + index)).x; }

/// A segment whose visibility decides whether `value` counts. Both ends lie off their surfaces by the error bound.
void storeShadowRay(uint slot, real3 origin, uint originPrimitive, real3 target, uint targetPrimitive, real3 value) {
    uint at = slot * SHADOW_TEXELS;
    shadowOut[at] = uvec4(floatBitsToUint(origin), originPrimitive);
    shadowOut[at + 1u] = uvec4(floatBitsToUint(target - origin), targetPrimitive);
    shadowOut[at + 2u].xyz = floatBitsToUint(value);
}

/// The pixel that a splat goes to, beside its shadow ray.
void storeSplatPixel(uint slot, uint pixel) { shadowOut[slot * SHADOW_TEXELS + 2u].w = pixel; }

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
