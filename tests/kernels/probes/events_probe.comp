#version 460
#extension GL_GOOGLE_include_directive : require
// a: a contribution, 1 where it was drawn with zero density    VARIANT: its source
#include "lib/common.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    real3 value = inputA[i].xyz;
    countInvalid(VARIANT, nonFinite(value), any(lessThan(value, real3(0.0))), inputA[i].w != 0.0);
}
