#version 460
#extension GL_GOOGLE_include_directive : require
// VARIANT 0, randomBlock: a: path, stream, vertex, block (bits)    out a: numbers
// VARIANT 1, randomIndex: a: bits, count (bits)                    out a: index (bits)
// VARIANT 2, scrambledPoint: a: as of 0                            out a: numbers of 24 bits
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    uvec4 at = floatBitsToUint(inputA[i]);
    if (VARIANT == 0u) outputA[i] = randomBlock(at.x, at.y, at.z, at.w);
    if (VARIANT == 1u) outputA[i] = vec4(uintBitsToFloat(randomIndex(at.x, at.y)), 0.0, 0.0, 0.0);
    if (VARIANT == 2u) outputA[i] = vec4(scrambledPoint(at.x, at.y, at.z, at.w) >> 8) * 5.9604644775390625e-8;
}
