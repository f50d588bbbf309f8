// What each technique of the camera path adds to the image, in layers that add up to it exactly.
#ifndef ANTIPODE_TECHNIQUE_LAYERS
#define ANTIPODE_TECHNIQUE_LAYERS
#include "lib/film.glsl"
#include "lib/state.glsl"

/// Parts one channel of the sample that addSample() adds. The image rounds the sum of the parts once; here every part
/// is rounded by the same random number, and the greatest takes what is left of the image's whole number: so the layers
/// add up to it, and each keeps its mean to the rounding of the floats.
void partChannel(uint pixel, uint channel, real total, real parts[CAMERA_TECHNIQUES], uint random_) {
    uvec2 rest;
    if (!roundSample(total * job.cameraUp.w, random_, rest)) return;
    uint greatest = 0u;
    for (uint t = 1u; t < CAMERA_TECHNIQUES; ++t) greatest = parts[t] > parts[greatest] ? t : greatest;
    for (uint t = 0u; t < CAMERA_TECHNIQUES; ++t) {
        uvec2 whole;
        if (t == greatest || parts[t] == 0.0 || !roundSample(parts[t] * job.cameraUp.w, random_, whole)) continue;
        rest = uvec2(rest.x - whole.x, rest.y - whole.y - (rest.x < whole.x ? 1u : 0u));
        if (layer(1u << t)) addToLayers(layerBase(1u << t) + 3u * pixel + channel, whole);
    }
    if (layer(1u << greatest)) addToLayers(layerBase(1u << greatest) + 3u * pixel + channel, rest);
}

void addTechniqueLayers(uint pixel, uint slot, real3 total) {
    if (nonFinite(total)) return;
    uint random_ = roundingBits(pixel, framePixel(pixel), 0u);
    for (uint channel = 0u; channel < 3u; ++channel) {
        real parts[CAMERA_TECHNIQUES];
        for (uint t = 0u; t < CAMERA_TECHNIQUES; ++t) parts[t] = techniqueRadiance[t * push.batchSize + slot][channel];
        partChannel(pixel, channel, total[channel], parts, random_);
    }
}
#endif
