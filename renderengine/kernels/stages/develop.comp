#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the radiance of the batch's camera paths to the film.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/technique_layers.glsl"

void main() {
    uint slot = interleavedIndex();
    uint pixel = push.pathBase + slot;
    if (slot >= push.batchSize) return;
    real3 value = radiance[slot].xyz;
    addSample(pixel, value, framePixel(pixel), 0u, 0u);
    if (layer(LAYERS_OF_CAMERA_TECHNIQUES)) addTechniqueLayers(pixel, slot, value);
}
