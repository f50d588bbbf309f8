#version 460
#extension GL_GOOGLE_include_directive : require
// a: path, stream, vertex, block (bits)    out a: randomBlock
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    uvec4 at = floatBitsToUint(inputA[i]);
    outputA[i] = randomBlock(at.x, at.y, at.z, at.w);
}
