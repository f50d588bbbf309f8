#version 460
#extension GL_GOOGLE_include_directive : require
// Merges a camera vertex with the light vertices within the radius. One dispatch visits a window of MERGE_WINDOW
// candidates, `stageIndex` says which, so that its loops stay bounded however many vertices share a cell.
#include "lib/common.glsl"
#include "lib/alpha.glsl"
#include "lib/vertex.glsl"
#include "lib/grid.glsl"

layout(set = 0, binding = BIND_CELLS) uniform usamplerBuffer cells;

// With LAYER_BLUR: marks gathered vertices in the inner half of the disk. There are fewer than 2^31 vertices.
const uint INNER_HALF = 1u << 31;

void main() {
    uint index = interleavedIndex();
    if (index >= liveCount()) return;
    uint slot = queueEntry(index);
    PathVertex v = loadPathVertex(slot, false);
    if (!merges(v)) return;
    uint edges = pathLength(v.path);
    real3 x = v.position;
    real radius2 = push.radius * push.radius;
    real reach = push.radius * (1.0 + 8.0 * UNIT_ROUNDOFF);
    ivec3 least = cellOf(x - reach), greatest = cellOf(x + reach);

    // The non-empty cells around the vertex, less the candidates of earlier windows. Kept in registers, as is the list
    // of what is in reach: an indexed array would be memory, and costs more than shifting the whole list.
    uint skip = push.stageIndex * MERGE_WINDOW, left = MERGE_WINDOW;
    uvec4 first0 = uvec4(0u), first1 = uvec4(0u), end0 = uvec4(0u), end1 = uvec4(0u);
    for (uint corner = 0u; corner < 8u; ++corner) {
        ivec3 cell = least + ivec3(corner & 1u, (corner >> 1) & 1u, corner >> 2);
        uvec2 range = texelFetch(cells, int(bucketOf(cell))).xy;
        if (any(greaterThan(cell, greatest))) range = uvec2(0u);
        uint passed = min(skip, range.y - range.x);
        skip -= passed;
        range.x += passed;
        range.y = min(range.y, range.x + left);
        left -= range.y - range.x;
        if (range.x < range.y) {
            first1 = uvec4(first0.w, first1.xyz);
            first0 = uvec4(range.x, first0.xyz);
            end1 = uvec4(end0.w, end1.xyz);
            end0 = uvec4(range.y, end0.xyz);
        }
    }

    // The candidates in those cells, a few in reach at a time.
    // `blur`: the sum over the outer half of the disk's area less that over the inner.
    real3 sum = real3(0.0), smallest = real3(0.0), blur = real3(0.0);
    bool more = true;
    while (more) {
        // First the vertices in reach are gathered, then the costly part is done for all lanes together.
        uint gathered = 0u;
        uvec4 reached0 = uvec4(0u), reached1 = uvec4(0u);
        while (gathered < 8u && first0.x < end0.x) {
            uint at = first0.x++;
            Record candidate = fetchRecord(vertexPositions, at);
            real3 d = recordVector(candidate) - x;
            real distance2 = dot(d, d);
            if (distance2 < radius2 && !isMediumPoint(recordTag(candidate))) {
                if (layer(LAYER_BLUR) && distance2 < 0.5 * radius2) at |= INNER_HALF;
                reached1 = uvec4(reached0.w, reached1.xyz);
                reached0 = uvec4(at, reached0.xyz);
                gathered++;
            }
            if (first0.x >= end0.x) {
                first0 = uvec4(first0.yzw, first1.x);
                first1 = uvec4(first1.yzw, 0u);
                end0 = uvec4(end0.yzw, end1.x);
                end1 = uvec4(end1.yzw, 0u);
            }
        }
        more = first0.x < end0.x;
        // Left early: a driver's loop limit cut the search short.
        if (more && gathered < 8u) {
            countEvent(SOURCE_MERGE, EVENT_LOOP_LIMIT);
            more = false;
        }
        for (uint i = 0u; i < gathered; ++i) {
            uint at = reached0.x;
            reached0 = uvec4(reached0.yzw, reached1.x);
            reached1 = uvec4(reached1.yzw, 0u);
            bool inner = layer(LAYER_BLUR) && (at & INNER_HALF) != 0u;
            if (layer(LAYER_BLUR)) at &= ~INNER_HALF;
            LightArrival y = loadLightArrival(at);
            real pdf, reversePdf;
            real3 f = evalVertex(v, y.back, pdf, reversePdf) * mergeGain(v, y.back);
            real w = weightMerge(v.endDensity, v.path.dVC, y.endDensity, y.dVC, pdf, reversePdf);
            bool wanted = wantedLength(edges + y.edges) && wantedTechnique(y.edges + 1u, edges + 1u) && f != real3(0.0);
            real3 value = f * y.throughput * w;
            if (wanted) {
                real3 seen = seenAtWavelength(value, isDispersed(v) || y.dispersed);
                sum += seen;
                if (layer(LAYER_BLUR)) blur += inner ? -seen : seen;
                smallest = min(smallest, value);
            }
        }
    }

    // The density estimate: flux in reach over πr²N.
    real3 merged = v.path.throughput * sum * push.inverseMergeCount;
    real coverage = feature(FEATURE_BLENDING) ? coverageAt(v.surface.material, v.surface.uv) : 1.0;
    if (feature(FEATURE_BLENDING)) merged /= coverage;
    countInvalid(SOURCE_MERGE, nonFinite(merged), any(lessThan(smallest, real3(0.0))), false);
    addRadiance(slot, LAYER_MERGE, merged);
    if (layer(LAYER_BLUR)) addBlur(slot, v.path.throughput * blur * (push.inverseMergeCount / coverage));
}
