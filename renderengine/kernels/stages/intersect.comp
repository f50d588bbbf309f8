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
    vec4 origin = pathOrigin[slot], direction = pathDirection[slot];
    Hit hit = intersect(origin.xyz, direction.xyz, INFINITE_DISTANCE, floatBitsToUint(origin.w), NO_INDEX, false);
    hits[slot] = uvec4(floatBitsToUint(hit.t), floatBitsToUint(hit.b1), floatBitsToUint(hit.b2), hit.primitive);
}
