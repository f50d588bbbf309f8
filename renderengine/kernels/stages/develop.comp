#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the radiance of the batch's camera paths to the film.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/technique_layers.glsl"

/// Of a path whose radiance is finite.
void addBlurSample(uint pixel, real difference) {
    uvec2 whole;
    uint random_ = randomBits(framePixel(pixel), 0u, framePixel(pixel), RANDOM_ROUNDING).z;
    if (roundSample(difference * min(job.cameraUp.w, real(1u << BLUR_SCALE_EXPONENT)), random_, whole))
        addToLayers(layerBase(LAYER_BLUR) + pixel, whole);
    else
        countEvent(SOURCE_FILM, EVENT_SATURATED);
}

void main() {
    uint slot = interleavedIndex();
    uint pixel = push.pathBase + slot;
    if (slot >= push.batchSize) return;
    real4 found = radiance[slot];
    real3 value = found.xyz;
    addSample(pixel, value, framePixel(pixel), 0u, 0u);
    if (layer(LAYERS_OF_CAMERA_TECHNIQUES)) addTechniqueLayers(pixel, slot, value);
    if (layer(LAYER_BLUR) && !nonFinite(value)) addBlurSample(pixel, found.w);
}
