#version 460
#extension GL_GOOGLE_include_directive : require
// VARIANT 0, store:  a: position, number (bits) of light vertex i
// VARIANT 1, sorted: out a: position, number of the i-th in cell order    out b: its bucket, the number that the sort
//                    carried, the bucket's first and end vertex (bits)    out c: bucket computed anew (bits)
// VARIANT 2, query:  a: position    out a: how many vertices lie in reach, sum of their numbers, of the numbers' hashes
// (bits).
//                    As merge.comp, one window (`stageIndex`) of candidates a run.
#include "lib/common.glsl"
#include "lib/grid.glsl"
#include "lib/record.glsl"
#include "probe.glsl"
layout(set = 0, binding = BIND_VERTEX_POSITIONS_OUT, std430) writeonly buffer Positions { Record positions[]; };
layout(set = 0, binding = BIND_VERTEX_POSITIONS) uniform usamplerBuffer vertexPositions;
layout(set = 0, binding = BIND_SORT_KEYS, std430) readonly buffer SortKeys { uvec2 sortKeys[]; };
layout(set = 0, binding = BIND_CELLS) uniform usamplerBuffer cells;

void query(uint i) {
    real3 x = inputA[i].xyz;
    real radius2 = push.radius * push.radius;
    real reach = push.radius * (1.0 + 8.0 * UNIT_ROUNDOFF);
    ivec3 least = cellOf(x - reach), greatest = cellOf(x + reach);
    uint skip = push.stageIndex * MERGE_WINDOW, left = MERGE_WINDOW;
    uvec3 found = uvec3(0u);
    for (uint corner = 0u; corner < 8u; ++corner) {
        ivec3 cell = least + ivec3(corner & 1u, (corner >> 1) & 1u, corner >> 2);
        if (any(greaterThan(cell, greatest))) continue;
        uvec2 range = texelFetch(cells, int(bucketOf(cell))).xy;
        uint passed = min(skip, range.y - range.x);
        skip -= passed;
        range.x += passed;
        range.y = min(range.y, range.x + left);
        left -= range.y - range.x;
        for (uint at = range.x; at < range.y; ++at) {
            Record vertex = fetchRecord(vertexPositions, at);
            real3 d = recordVector(vertex) - x;
            uint number = recordTag(vertex);
            if (dot(d, d) < radius2) found += uvec3(1u, number, number * 2654435761u ^ (number >> 7));
        }
    }
    outputA[i] = vec4(uintBitsToFloat(found), uintBitsToFloat(skip == 0u && left == 0u ? 1u : 0u));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    if (VARIANT == 0u) {
        positions[i] = packRecord(inputA[i]);
    } else if (VARIANT == 1u) {
        Record vertex = fetchRecord(vertexPositions, i);
        uvec2 entry = sortKeys[(push.stageIndex & 1u) * push.vertexCapacity + i];
        outputA[i] = vec4(recordVector(vertex), uintBitsToFloat(recordTag(vertex)));
        outputB[i] = uintBitsToFloat(uvec4(entry, texelFetch(cells, int(entry.x)).xy));
        outputC[i] = vec4(uintBitsToFloat(bucketOf(cellOf(recordVector(vertex)))), 0.0, 0.0, 0.0);
    } else {
        query(i);
    }
}
