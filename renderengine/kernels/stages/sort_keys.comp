#version 460
#extension GL_GOOGLE_include_directive : require
// Bucket of every light vertex.
#include "lib/common.glsl"
#include "lib/grid.glsl"
#include "lib/record.glsl"
#include "lib/sort.glsl"
layout(set = 0, binding = BIND_VERTEX_POSITIONS_OUT, std430) readonly buffer Positions { Record positions[]; };

void main() {
    uint i = flatIndex();
    if (i < push.vertexCount) sortKeys[i] = uvec2(bucketOf(cellOf(recordVector(positions[i]))), i);
}
