#version 460
#extension GL_GOOGLE_include_directive : require
// Between two waves, by one invocation: counts of the next queue, indirect arguments, ray statistics.
// VARIANT 0: after a compaction; VARIANT 1: at the start of a batch, when all slots are queued.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/scan.glsl"

void addTo(uint counter, uint value) {
    uint before = counters[counter];
    counters[counter] = before + value;
    if (before + value < before) counters[counter + 1u]++;
}

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    uint next = 1u - push.queueParity;
    uint live;
    if (VARIANT == 1u) {
        next = push.queueParity;
        live = push.batchSize;
    } else {
        uint chunks = chunkCount(liveCount());
        live = scan[chunks];
        counters[COUNTER_VERTICES + next] = counters[COUNTER_VERTICES + push.queueParity] + scan[2u * chunks] - live;
        for (uint i = 0u; i < MAX_SHADOW_QUEUES; ++i) {
            addTo(COUNTER_SHADOW_RAYS, counters[COUNTER_SHADOW_QUEUE + i]);
            counters[COUNTER_SHADOW_QUEUE + i] = 0u;
        }
        addTo(COUNTER_RAYS, live);
    }
    counters[COUNTER_QUEUE + next] = live;
    counters[COUNTER_GROUPS] = (live + push.elementCount - 1u) / push.elementCount;
    counters[COUNTER_GROUPS + 1u] = counters[COUNTER_GROUPS + 2u] = 1u;
    counters[COUNTER_CHUNK_GROUPS] = (chunkCount(live) + push.elementCount - 1u) / push.elementCount;
    counters[COUNTER_CHUNK_GROUPS + 1u] = counters[COUNTER_CHUNK_GROUPS + 2u] = 1u;
}
