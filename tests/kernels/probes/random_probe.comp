#version 460
#extension GL_GOOGLE_include_directive : require
// VARIANT 0, randomBlock: a: path, stream, vertex, block (bits)    out a: numbers
// VARIANT 1, randomIndex: a: bits, count (bits)                    out a: index (bits)
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    uvec4 at = floatBitsToUint(inputA[i]);
    outputA[i] = VARIANT == 0u ? randomBlock(at.x, at.y, at.z, at.w)
                               : vec4(uintBitsToFloat(randomIndex(at.x, at.y)), 0.0, 0.0, 0.0);
}
