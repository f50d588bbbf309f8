#version 460
#extension GL_GOOGLE_include_directive : require
// The fullest bucket bounds how many windows of candidates a merge needs.
#include "lib/common.glsl"
layout(set = 0, binding = BIND_CELLS_OUT, std430) readonly buffer Cells { uvec2 cellRanges[]; };

void main() {
    uint i = flatIndex();
    if (i >= push.bucketCount) return;
    uint size = cellRanges[i].y - cellRanges[i].x;
    if (size > counters[COUNTER_MAX_CELL]) atomicMax(counters[COUNTER_MAX_CELL], size);
}
