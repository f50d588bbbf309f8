#version 460
#extension GL_GOOGLE_include_directive : require
// a: unit direction, number (bits)    out a: tangent, number unpacked (bits)    out b: bitangent    out c: direction unpacked
#include "lib/common.glsl"
#include "lib/frame.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    real3 t, b;
    tangentFrame(inputA[i].xyz, t, b);
    uvec2 bits = packDirection(inputA[i].xyz, floatBitsToUint(inputA[i].w));
    outputA[i] = vec4(t, uintBitsToFloat(unpackNumber(bits)));
    outputB[i] = vec4(b, 0.0);
    outputC[i] = vec4(unpackDirection(bits), 0.0);
}
