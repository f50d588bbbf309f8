#version 460
#extension GL_GOOGLE_include_directive : require
// a: origin, tMax    b: direction, primitive to skip or NO_INDEX    VARIANT 1: any hit    out a: t, b1, b2, primitive
#include "lib/common.glsl"
#include "lib/traversal.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    Hit hit = intersect(inputA[i].xyz, inputB[i].xyz, inputA[i].w, floatBitsToUint(inputB[i].w), NO_INDEX,
                        VARIANT == 1u, SOURCE_CAMERA_TRACE, 0u);
    outputA[i] = vec4(hit.t, hit.b1, hit.b2, uintBitsToFloat(hit.primitive));
}
