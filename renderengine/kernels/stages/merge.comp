#version 460
#extension GL_GOOGLE_include_directive : require
// Merges a camera vertex with the light vertices within the radius. One dispatch visits a window of MERGE_WINDOW
// candidates, `stageIndex` says which, so that its loops stay bounded however many vertices share a cell.
#include "lib/common.glsl"
#include "lib/hit.glsl"
#include "lib/vertex.glsl"
#include "lib/grid.glsl"

layout(set = 0, binding = BIND_CELLS) uniform usamplerBuffer cells;

void main() {
    uint index = interleavedIndex();
    if (index >= liveCount()) return;
    uint slot = queueEntry(index);
    SurfaceHit h = loadSurfaceHit(slot);
    if (!h.valid || h.bsdf.specular || h.bsdf.black) return;
    uint edges = pathLength(h.path);
    real3 x = h.surface.position;
    real radius2 = push.radius * push.radius;
    real reach = push.radius * (1.0 + 8.0 * UNIT_ROUNDOFF);
    ivec3 least = cellOf(x - reach), greatest = cellOf(x + reach);
    real cameraJoin = cameraEndCount(edges) * h.path.dVCM;

    uint skip = push.stageIndex * MERGE_WINDOW, left = MERGE_WINDOW;
    uint corner = 0u, at = 0u, end = 0u;
    real3 sum = real3(0.0);
    while (true) {
        // Lanes run ahead to their next vertex in reach, so that the costly part is done together.
        bool found = false;
        uvec4 candidate;
        while (!found && left > 0u && (at < end || corner < 8u)) {
            if (at >= end) {
                ivec3 cell = least + ivec3(corner & 1u, (corner >> 1) & 1u, corner >> 2);
                corner++;
                uvec2 range = texelFetch(cells, int(bucketOf(cell))).xy;
                if (any(greaterThan(cell, greatest))) range = uvec2(0u);
                uint passed = min(skip, range.y - range.x);
                skip -= passed;
                at = range.x + passed;
                end = range.y;
            } else {
                candidate = texelFetch(vertexPositions, int(at));
                real3 d = uintBitsToFloat(candidate.xyz) - x;
                found = dot(d, d) < radius2;
                at++;
                left--;
            }
        }
        if (!found) break;
        LightVertex y = loadLightVertexData(at - 1u, candidate);
        real pdf, reversePdf;
        real3 f = evalBsdf(h.bsdf, h.back, y.direction, false, pdf, reversePdf);
        if (feature(FEATURE_ATTRIBUTES)) f *= abs(dot(y.direction, h.bsdf.n) / dot(y.direction, h.bsdf.ng));
        // eq. 38, 39
        real w = term(TERM_FIRST_DIFFUSE) ? 1.0
               : misWeight((y.dVCM + y.dVC * pdf) * push.inverseMergeCount, (cameraJoin + h.path.dVC * reversePdf) * push.inverseMergeCount);
        bool wanted = wantedLength(edges + y.length_) && wantedTechnique(y.length_ + 1u, edges + 1u) && f != real3(0.0);
        if (wanted) sum += f * y.throughput * w;
    }
    // The window ran out only if `left` is 0; anything else unfinished was cut by a driver's loop limit.
    if (left > 0u && (at < end || corner < 8u)) countEvent(COUNTER_LOOP_LIMIT);
    radiance[slot] += vec4(h.path.throughput * sum * push.inverseMergeCount, 0.0);
}
