#version 460
#extension GL_GOOGLE_include_directive : require
// Between two waves, by one invocation: counts of the next queue, indirect arguments, ray statistics.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/scan.glsl"

const uint START = 0;      // of a batch: all its slots are queued
const uint COMPACTED = 1;  // after an order-preserving compaction: the scan holds the counts
const uint APPENDED = 2;   // after paths appended themselves to the next queue

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    uint next = VARIANT == START ? push.queueParity : 1u - push.queueParity;
    uint live = push.batchSize;
    if (VARIANT == COMPACTED) {
        uint chunks = chunkCount(liveCount());
        live = scan[chunks];
        counters[COUNTER_VERTICES + next] = counters[COUNTER_VERTICES + push.queueParity] + scan[2u * chunks] - live;
    }
    if (VARIANT == APPENDED) live = counters[COUNTER_QUEUE + next];
    if (VARIANT != START) {
        counters[COUNTER_SHADOW_RAYS] += counters[COUNTER_SHADOW_QUEUE];
        counters[COUNTER_SHADOW_QUEUE] = 0u;
        for (uint i = 1u; i < MAX_SHADOW_QUEUES; ++i) {
            counters[COUNTER_CONNECTION_RAYS] += counters[COUNTER_SHADOW_QUEUE + i];
            counters[COUNTER_SHADOW_QUEUE + i] = 0u;
        }
    }
    if (VARIANT != START) counters[COUNTER_RAYS] += live;
    counters[COUNTER_QUEUE + next] = live;
    counters[COUNTER_QUEUE + 1u - next] = 0u;
    counters[COUNTER_GROUPS] = (live + push.elementCount - 1u) / push.elementCount;
    counters[COUNTER_GROUPS + 1u] = counters[COUNTER_GROUPS + 2u] = 1u;
    counters[COUNTER_CHUNK_GROUPS] = (chunkCount(live) + push.elementCount - 1u) / push.elementCount;
    counters[COUNTER_CHUNK_GROUPS + 1u] = counters[COUNTER_CHUNK_GROUPS + 2u] = 1u;
}
