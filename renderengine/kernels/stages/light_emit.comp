#version 460
#extension GL_GOOGLE_include_directive : require
// Starts the batch's light paths on the emitters.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/state.glsl"
#include "lib/light.glsl"

void main() {
    uint slot = interleavedIndex();
    bool queued = slot < push.batchSize;
    uint id = push.pathBase + slot;
    Emission e = sampleEmission(randomChoiceAndPoint(id, RANDOM_LIGHT, 0, RANDOM_START),
                                randomBlock(id, RANDOM_LIGHT, 0, RANDOM_START_MORE));
    Path path;
    path.origin = e.origin;
    path.originPrimitive = e.primitive;
    path.direction = e.direction;
    path.flags = 1u | PATH_SPECULAR | (e.infinite ? PATH_FROM_INFINITY : 0u);
    path.throughput = e.throughput;
    path.dVCM = e.dVCM;
    path.dVC = e.dVC * push.hitCount;
    path.lossless = max(e.throughput.x, max(e.throughput.y, e.throughput.z));
    countInvalid(SOURCE_LIGHT_EMISSION, queued && e.valid && (nonFinite(e.throughput) || nonFinite(e.direction)),
                 queued && e.valid && any(lessThan(e.throughput, real3(0.0))), queued && !e.valid);
    bool alive = queued && e.valid && max(e.throughput.x, max(e.throughput.y, e.throughput.z)) > 0.0;
    if (alive) storePath(slot, path);
    if (!term(TERM_CONNECT | TERM_MERGE)) {
        enqueuePath(alive, slot);
    } else if (queued) {
        slotFlags[slot] = alive ? SLOT_ALIVE : 0u;
        queuesOut[push.queueParity * push.batchSize + slot] = slot;
    }
}
