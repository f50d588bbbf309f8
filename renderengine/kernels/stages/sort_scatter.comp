#version 460
#extension GL_GOOGLE_include_directive : require
// Moves one chunk of keys to their places.
#include "lib/common.glsl"
#include "lib/scan.glsl"
#include "lib/sort.glsl"

void main() {
    uint chunk = flatIndex();
    if (chunk >= sortChunks()) return;
    for (uint digit = 0u; digit < SORT_DIGITS; ++digit) digitCount[digitAt(digit)] = scan[digit * sortChunks() + chunk];
    uint end = min(push.vertexCount, (chunk + 1u) * SORT_CHUNK);
    for (uint i = chunk * SORT_CHUNK; i < end; ++i) {
        uvec2 entry = sortKeys[sortSource() + i];
        sortKeys[sortTarget() + digitCount[digitAt(sortDigit(entry.x))]++] = entry;
    }
}
