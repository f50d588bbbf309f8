#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the radiance of the batch's camera paths to the film.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/film.glsl"

void main() {
    uint slot = interleavedIndex();
    uint pixel = push.pathBase + slot;
    if (slot < push.batchSize) addSample(pixel, radiance[slot].xyz, pixel, 0u);
}
