#version 460
#extension GL_GOOGLE_include_directive : require
// Copies the light vertices into cell order and notes where each bucket begins and ends.
#include "lib/common.glsl"
#include "lib/record.glsl"
#include "lib/sort.glsl"
layout(set = 0, binding = BIND_VERTEX_POSITIONS_OUT, std430) readonly buffer Positions { Record positions[]; };
layout(set = 0, binding = BIND_VERTEX_DATA_OUT, std430) readonly buffer Data { Record data[]; };
layout(set = 0, binding = BIND_SORTED_POSITIONS_OUT, std430) writeonly buffer SortedPositions {
    Record sortedPositions[];
};
layout(set = 0, binding = BIND_SORTED_DATA_OUT, std430) writeonly buffer SortedData { Record sortedData[]; };
layout(set = 0, binding = BIND_CELLS_OUT, std430) buffer Cells { uvec2 cellRanges[]; };

void main() {
    uint i = flatIndex();
    if (i >= push.vertexCount) return;
    uvec2 entry = sortKeys[sortSource() + i];
    sortedPositions[i] = positions[entry.y];
    sortedData[2u * i] = data[2u * entry.y];
    sortedData[2u * i + 1u] = data[2u * entry.y + 1u];
    if (i == 0u || sortKeys[sortSource() + i - 1u].x != entry.x) cellRanges[entry.x].x = i;
    if (i + 1u == push.vertexCount || sortKeys[sortSource() + i + 1u].x != entry.x) cellRanges[entry.x].y = i + 1u;
}
