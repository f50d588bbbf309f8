#version 460
#extension GL_GOOGLE_include_directive : require
// a: where light comes from, g    b: two random numbers    out a: a sampled direction, its density
#include "lib/common.glsl"
#include "lib/phase.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    real3 direction = samplePhase(inputA[i].xyz, inputA[i].w, inputB[i].xy);
    outputA[i] = vec4(direction, phaseFunction(inputA[i].xyz, direction, inputA[i].w));
}
