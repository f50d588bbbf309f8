#version 460
#extension GL_GOOGLE_include_directive : require
// Exclusive prefix sums in place, by one workgroup; the total follows the last element. VARIANT 0: over the two counts
// of every chunk of the live queue; VARIANT 1: over `elementCount` elements.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/scan.glsl"

shared uint partial[gl_WorkGroupSize.x];

void main() {
    uint count = VARIANT == 0u ? 2u * chunkCount(liveCount()) : push.elementCount;
    uint lane = gl_LocalInvocationID.x;
    uint share = (count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(lane * share, count), end = min(begin + share, count);
    uint sum = 0u;
    for (uint i = begin; i < end; ++i) sum += scan[i];
    partial[lane] = sum;
    barrier();
    uint before = 0u;
    for (uint i = 0u; i < lane; ++i) before += partial[i];
    for (uint i = begin; i < end; ++i) {
        uint value = scan[i];
        scan[i] = before;
        before += value;
    }
    if (lane == gl_WorkGroupSize.x - 1u) scan[count] = before;
}
