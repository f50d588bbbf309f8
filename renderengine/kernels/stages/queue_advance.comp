#version 460
#extension GL_GOOGLE_include_directive : require
// Between two waves, by one invocation: counts of the next queue, indirect arguments, ray statistics.
// `stageIndex` says what went before, one of QUEUE_*.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/scan.glsl"

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    // Paths that live on, and light vertices so far.
    uint next = push.stageIndex == QUEUE_START ? push.queueParity : 1u - push.queueParity;
    uint live = push.batchSize;
    if (push.stageIndex == QUEUE_COMPACTED) {
        uint chunks = chunkCount(liveCount());
        live = scan[chunks];
        counters[COUNTER_VERTICES + next] = counters[COUNTER_VERTICES + push.queueParity] + scan[2u * chunks] - live;
    }
    if (push.stageIndex == QUEUE_APPENDED) live = counters[COUNTER_QUEUE + next];
    // Rays that were traced, by their kind.
    if (push.stageIndex != QUEUE_START) {
        counters[COUNTER_SHADOW_RAYS] += counters[COUNTER_SHADOW_QUEUE];
        counters[COUNTER_SHADOW_QUEUE] = 0u;
        for (uint i = 1u; i < MAX_SHADOW_QUEUES; ++i) {
            counters[COUNTER_CONNECTION_RAYS] += counters[COUNTER_SHADOW_QUEUE + i];
            counters[COUNTER_SHADOW_QUEUE + i] = 0u;
        }
    }
    if (push.stageIndex != QUEUE_START) counters[COUNTER_RAYS] += live;
    // The next wave: its queue, an empty one behind it, and the groups that its stages are dispatched with.
    counters[COUNTER_QUEUE + next] = live;
    counters[COUNTER_QUEUE + 1u - next] = 0u;
    counters[COUNTER_GROUPS] = (live + push.elementCount - 1u) / push.elementCount;
    counters[COUNTER_GROUPS + 1u] = counters[COUNTER_GROUPS + 2u] = 1u;
    counters[COUNTER_CHUNK_GROUPS] = (chunkCount(live) + push.elementCount - 1u) / push.elementCount;
    counters[COUNTER_CHUNK_GROUPS + 1u] = counters[COUNTER_CHUNK_GROUPS + 2u] = 1u;
}
