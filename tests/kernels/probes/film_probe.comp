#version 460
#extension GL_GOOGLE_include_directive : require
// VARIANT 0, addToChannel: a.x: value, a.y: channel (bits), a.z: random bits    VARIANT 1, addSample: a: value, pixel
// (bits)
#include "lib/common.glsl"
#include "lib/film.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    if (VARIANT == 0u)
        addToChannel(floatBitsToUint(inputA[i].y), inputA[i].x, floatBitsToUint(inputA[i].z), 0u);
    else
        addSample(floatBitsToUint(inputA[i].w), inputA[i].xyz, i, 0u, 0u);
}
