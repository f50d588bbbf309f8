#version 460
#extension GL_GOOGLE_include_directive : require
// a: densities pA, pB of two techniques    out a: weights of A and of B
#include "lib/common.glsl"
#include "lib/mis.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    real a = inputA[i].x, b = inputA[i].y;
    outputA[i] = vec4(misWeight(b / a, 0.0), misWeight(0.0, a / b), 0.0, 0.0);
}
