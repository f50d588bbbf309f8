#version 460
#extension GL_GOOGLE_include_directive : require
// First step of the order-preserving compaction of a queue: each invocation counts the live and the stored slots of
// one chunk. Order matters: it fixes the index of every light vertex, and with it every later sum of floats.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/scan.glsl"

void main() {
    uint chunk = flatIndex();
    uint count = liveCount(), chunks = chunkCount(count);
    if (chunk >= chunks) return;
    uint end = min(count, (chunk + 1u) * COMPACT_CHUNK);
    uint alive = 0u, stored = 0u;
    for (uint i = chunk * COMPACT_CHUNK; i < end; ++i) {
        uint flags = slotFlags[i];
        alive += flags & SLOT_ALIVE;
        stored += (flags & SLOT_STORED) >> 1;
    }
    scan[chunk] = alive;
    scan[chunks + chunk] = stored;
}
