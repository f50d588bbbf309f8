// The state of paths between stages, and the queues of those that live.
#ifndef ANTIPODE_STATE
#define ANTIPODE_STATE
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(set = 0, binding = BIND_PATH_ORIGIN, std430) buffer PathOrigin { vec4 pathOrigin[]; };
layout(set = 0, binding = BIND_PATH_DIRECTION, std430) buffer PathDirection { vec4 pathDirection[]; };
layout(set = 0, binding = BIND_PATH_THROUGHPUT, std430) buffer PathThroughput { vec4 pathThroughput[]; };
layout(set = 0, binding = BIND_PATH_MIS, std430) buffer PathMis { float pathMis[]; };
layout(set = 0, binding = BIND_HIT, std430) buffer Hits { uvec4 hits[]; };
layout(set = 0, binding = BIND_RADIANCE, std430) buffer Radiance { vec4 radiance[]; };
layout(set = 0, binding = BIND_SHADOW, std430) buffer Shadow { uvec4 shadow[]; };
layout(set = 0, binding = BIND_QUEUES, std430) buffer Queues { uint queues[]; };
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

Path loadPath(uint slot) {
    vec4 origin = pathOrigin[slot], direction = pathDirection[slot], throughput = pathThroughput[slot];
    return Path(origin.xyz, floatBitsToUint(origin.w), direction.xyz, floatBitsToUint(direction.w), throughput.xyz,
                throughput.w, pathMis[slot]);
}

void storePath(uint slot, Path path) {
    pathOrigin[slot] = vec4(path.origin, uintBitsToFloat(path.originPrimitive));
    pathDirection[slot] = vec4(path.direction, uintBitsToFloat(path.flags));
    pathThroughput[slot] = vec4(path.throughput, path.dVCM);
    pathMis[slot] = path.dVC;
}

uint liveCount() { return counters[COUNTER_QUEUE + push.queueParity]; }
uint queueEntry(uint index) { return queues[push.queueParity * push.batchSize + index]; }

/// A segment whose visibility decides whether `value` counts. Both ends lie off their surfaces by the error bound.
void storeShadowRay(uint slot, real3 origin, uint originPrimitive, real3 target, uint targetPrimitive, real3 value,
                    uint pixel) {
    shadow[3 * slot] = uvec4(floatBitsToUint(origin), originPrimitive);
    shadow[3 * slot + 1] = uvec4(floatBitsToUint(target - origin), targetPrimitive);
    shadow[3 * slot + 2] = uvec4(floatBitsToUint(value), pixel);
}

/// Appends the slots of the invocations that want it to shadow queue `index`. Their order does not matter: each path
/// has at most one entry, and what an entry adds is either its own path's or an integer sum.
void enqueueShadowRay(bool wanted, uint index, uint slot) {
    uvec4 ballot = subgroupBallot(wanted);
    uint count = subgroupBallotBitCount(ballot);
    uint base = 0;
    if (subgroupElect() && count > 0) base = atomicAdd(counters[COUNTER_SHADOW_QUEUE + index], count);
    base = subgroupBroadcastFirst(base);
    if (wanted) queues[2 * push.batchSize + base + subgroupBallotExclusiveBitCount(ballot)] = slot;
}
#endif
