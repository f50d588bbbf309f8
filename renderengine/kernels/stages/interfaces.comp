#version 460
#extension GL_GOOGLE_include_directive : require
// Where transparent bodies touch: which of them hold a path. VARIANT 0, after intersect: before and beyond the surface
// that the ray met. Whatever lies in the same place, as the two faces of glass on glass, is crossed as one interface,
// and an opaque wall there is what was met. At a point in a medium both sides are one. VARIANT 1: around the start of a
// new path. `stageIndex` is the source of events.
#include "lib/common.glsl"
#include "lib/state.glsl"
#include "lib/surface.glsl"
#include "lib/crossings.glsl"

void main() {
    uint index = interleavedIndex();
    if (index >= liveCount()) return;
    uint slot = queueEntry(index);
    uint at = MEDIA_TEXELS * slot;
    real3 origin = recordVector(fetchRecord(paths, slot * PATH_RECORDS));
    Crossings crossings = Crossings(uvec4(0u), NO_INDEX, 0u, 0.0, 0.0);
    // Two parts of the way: to before the surface that was met, and across it.
    real3 points[3];
    uint first = 0u, last = 1u;
    uint met = NO_INDEX;
    real3 hit = real3(0.0);
    if (VARIANT == 1u) {
        // From beyond all bodies, in a direction that meets nothing on an edge.
        points[0] = job.sceneCenter.xyz + job.sceneCenter.w * real3(1.37, 1.91, 1.73);
        points[1] = points[2] = origin;
    } else {
        real3 direction = recordVector(fetchRecord(paths, slot * PATH_RECORDS + 1u));
        Record record = fetchRecord(hits, slot);
        met = recordTag(record);
        if (met == NO_INDEX) return;
        hit = recordVector(record);
        bool point = isMediumPoint(met);
        real3 end = origin + hit.x * direction;
        uint primitive = point ? 0u : met;
        Surface surface = surfaceAt(primitive, hit.y, hit.z, end);
        points[0] = origin;
        points[1] = point ? end : leaveSurface(surface, -direction);
        points[2] = leaveSurface(surface, direction);
        crossings.ranks = media[at];
        // Outside all bodies nothing of a lower rank can have been passed; an opaque surface has no beyond.
        uint rank = point ? 0u : primitiveRank(texelFetch(primitives, int(3u * primitive + 2u)));
        first = topRank(crossings.ranks) == 0u ? 1u : 0u;
        last = rank == 0u ? 1u : 2u;
        if (rank == 0u) met = NO_INDEX;
    }
    // The bodies that hold the way, face by face.
    uvec4 before = crossings.ranks;
    for (uint part = first; part < last; ++part) {
        crossings.rank = 0u;
        crossFaces(crossings, part == 0u ? points[0] : points[1], part == 0u ? points[1] : points[2], VARIANT == 1u,
                   push.stageIndex);
        // What was left without having been entered does not hold the way so far, but the side that is left.
        uint owed = takeOwed(crossings.ranks);
        if (part == 0u) before = crossings.ranks;
        if (part == 1u && owed != 0u) crossFace(before, owed, true);
    }
    // What the next stages read: both sides, and where faces coincide the one that counts.
    media[at] = before;
    media[at + 1u] = crossings.ranks;
    if (met != NO_INDEX && last == 2u && crossings.rank != 0u && crossings.primitive != met)
        hitsOut[slot] = packRecord(real3(hit.x, crossings.b1, crossings.b2), crossings.primitive);
}
