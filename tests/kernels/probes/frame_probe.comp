#version 460
#extension GL_GOOGLE_include_directive : require
// a: unit direction    out a: tangent    out b: bitangent    out c: direction packed and unpacked
#include "lib/common.glsl"
#include "lib/frame.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    real3 t, b;
    tangentFrame(inputA[i].xyz, t, b);
    outputA[i] = vec4(t, 0.0);
    outputB[i] = vec4(b, 0.0);
    outputC[i] = vec4(unpackDirection(packDirection(inputA[i].xyz)), 0.0);
}
