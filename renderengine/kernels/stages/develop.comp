#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the radiance of the batch's camera paths to the film.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/film.glsl"

void main() {
    uint slot = interleavedIndex();
    if (slot < push.batchSize) addSample(push.pathBase + slot, radiance[slot].xyz);
}
