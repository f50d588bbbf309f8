#version 460
#extension GL_GOOGLE_include_directive : require
// Counts the digits of one chunk of keys, digit-major for the scan.
#include "lib/common.glsl"
#include "lib/scan.glsl"
#include "lib/sort.glsl"

void main() {
    uint chunk = flatIndex();
    for (uint digit = 0u; digit < SORT_DIGITS; ++digit) digitCount[digitAt(digit)] = 0u;
    if (chunk >= sortChunks()) return;
    uint end = min(push.vertexCount, (chunk + 1u) * SORT_CHUNK);
    for (uint i = chunk * SORT_CHUNK; i < end; ++i) digitCount[digitAt(sortDigit(sortKeys[sortSource() + i].x))]++;
    for (uint digit = 0u; digit < SORT_DIGITS; ++digit) scan[digit * sortChunks() + chunk] = digitCount[digitAt(digit)];
}
