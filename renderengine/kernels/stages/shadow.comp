#version 460
#extension GL_GOOGLE_include_directive : require
// Tests the visibility of a shadow queue's segments. VARIANT 0 adds what passes to the camera path's radiance,
// VARIANT 1 splats it onto the film.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/traversal.glsl"
#include "lib/film.glsl"

void main() {
    uint index = interleavedIndex();
    if (index >= counters[COUNTER_SHADOW_QUEUE + push.stageIndex]) return;
    uint slot = texelFetch(queues, int(2u * push.batchSize + index)).x;
    int at = int(slot * SHADOW_TEXELS);
    uvec4 origin = texelFetch(shadow, at), segment = texelFetch(shadow, at + 1), carried = texelFetch(shadow, at + 2);
    Hit hit = intersect(uintBitsToFloat(origin.xyz), uintBitsToFloat(segment.xyz), 1.0, origin.w, segment.w, true);
    if (hit.primitive != NO_INDEX) return;
    real3 value = uintBitsToFloat(carried.xyz);
    if (VARIANT == 1u)
        addSample(carried.w, value);
    else
        radiance[slot] += vec4(value, 0.0);
}
