#version 460
#extension GL_GOOGLE_include_directive : require
// Starts the batch's light paths on the emitters.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/mis.glsl"
#include "lib/light.glsl"

void main() {
    uint slot = interleavedIndex();
    bool queued = slot < push.batchSize;
    uint id = push.pathBase + slot;
    Emission emission = sampleEmission(randomChoiceAndPoint(id, RANDOM_LIGHT, 0, RANDOM_START),
                                       randomBlock(id, RANDOM_LIGHT, 0, RANDOM_START_MORE));
    Path path;
    path.origin = emission.origin;
    path.originPrimitive = emission.primitive;
    path.direction = emission.direction;
    path.flags = 1u | PATH_SPECULAR | (emission.infinite ? PATH_FROM_INFINITY : 0u);
    path.throughput = emission.throughput;
    startLightPath(path, emission.dVCM, emission.dVC);
    path.lossless = max(emission.throughput.x, max(emission.throughput.y, emission.throughput.z));
    countInvalid(SOURCE_LIGHT_EMISSION,
                 queued && emission.valid && (nonFinite(emission.throughput) || nonFinite(emission.direction)),
                 queued && emission.valid && any(lessThan(emission.throughput, real3(0.0))), queued && !emission.valid);
    bool alive =
        queued && emission.valid && max(emission.throughput.x, max(emission.throughput.y, emission.throughput.z)) > 0.0;
    if (alive) storePath(slot, path);
    if (!term(TERM_CONNECT | TERM_MERGE)) {
        enqueuePath(alive, slot);
    } else if (queued) {
        slotFlags[slot] = alive ? SLOT_ALIVE : 0u;
        queuesOut[push.queueParity * push.batchSize + slot] = slot;
    }
}
