#version 460
#extension GL_GOOGLE_include_directive : require
// a: t, b1, b2, primitive of a hit    b: the ray's point there    c: direction to leave in
// out a: start of the ray that leaves    out b: geometric normal, offset
#include "lib/common.glsl"
#include "lib/surface.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    Surface s = surfaceAt(floatBitsToUint(inputA[i].w), inputA[i].y, inputA[i].z, inputB[i].xyz);
    outputA[i] = vec4(leaveSurface(s, inputC[i].xyz), 0.0);
    outputB[i] = vec4(s.normal, s.offset);
}
