#version 460
#extension GL_GOOGLE_include_directive : require
// Finds the nearest surface along the ray of every live path.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/traversal.glsl"

void main() {
    uint index = interleavedIndex();
    if (index >= liveCount()) return;
    uint slot = queueEntry(index);
    uvec4 origin = texelFetch(paths, int(slot * PATH_TEXELS)), direction = texelFetch(paths, int(slot * PATH_TEXELS + 1u));
    Hit hit = intersect(uintBitsToFloat(origin.xyz), uintBitsToFloat(direction.xyz), INFINITE_DISTANCE, origin.w, NO_INDEX, false);
    hitsOut[slot] = uvec4(floatBitsToUint(hit.t), floatBitsToUint(hit.b1), floatBitsToUint(hit.b2), hit.primitive);
}
