#version 460
#extension GL_GOOGLE_include_directive : require
// Last step of the compaction: each invocation writes its chunk's live slots to the other queue, and its light vertices
// to their places behind those of earlier waves.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/scan.glsl"

layout(set = 0, binding = BIND_WAVE_VERTICES, std430) readonly buffer WaveVertices { Record waveVertices[]; };
layout(set = 0, binding = BIND_VERTEX_POSITIONS_OUT, std430) writeonly buffer Positions { Record positions[]; };
layout(set = 0, binding = BIND_VERTEX_DATA_OUT, std430) writeonly buffer Data { Record data[]; };

void main() {
    uint chunk = flatIndex();
    uint count = liveCount(), chunks = chunkCount(count);
    if (chunk >= chunks) return;
    uint alive = scan[chunk];
    uint stored = scan[chunks + chunk] - scan[chunks] + counters[COUNTER_VERTICES + push.queueParity];
    uint other = (1u - push.queueParity) * push.batchSize;
    uint end = min(count, (chunk + 1u) * COMPACT_CHUNK);
    for (uint i = chunk * COMPACT_CHUNK; i < end; ++i) {
        uint flags = slotFlags[i];
        if ((flags & SLOT_ALIVE) != 0u) queuesOut[other + alive++] = queueEntry(i);
        if ((flags & SLOT_STORED) != 0u) {
            if (stored < push.vertexCapacity) {
                uint at = VERTEX_RECORDS * i;
                positions[stored] = waveVertices[at];
                data[2u * stored] = waveVertices[at + 1u];
                data[2u * stored + 1u] = waveVertices[at + 2u];
            }
            stored++;
        }
    }
}
