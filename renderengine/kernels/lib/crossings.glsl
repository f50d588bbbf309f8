// All faces that a segment crosses, and what it is in beyond them.
#ifndef ANTIPODE_CROSSINGS
#define ANTIPODE_CROSSINGS
#include "lib/media.glsl"
#include "lib/traversal.glsl"

/// What a segment crosses.
struct Crossings {
    uvec4 ranks;     // the bodies around the segment's start, then around its end
    uint primitive;  // opaque, or of the greatest rank
    uint rank;       // its rank; beyond all for an opaque one
    real b1, b2;     // barycentrics there
};

const uint OPAQUE_RANK = 0xFFFFFFFFu;

/// The covering rule for an edge that a ray meets exactly: one of the two triangles that share it is met, not both.
bool insideEdge(real edge, real x0, real y0, real x1, real y1, bool counterClockwise) {
    bool mine = x0 < x1 || (x0 == x1 && y0 < y1);
    return counterClockwise ? edge > 0.0 || (edge == 0.0 && mine) : edge < 0.0 || (edge == 0.0 && !mine);
}

/// Crosses from `start` to `end` all faces that part them. Sides are those of the points, whatever the segment, so that
/// the bodies around a point are the same however it is reached. closedOnly: leaves out what bounds no volume.
void crossFaces(inout Crossings crossings, real3 start, real3 end, bool closedOnly, uint source) {
    // The segment as a ray whose parameter runs from 0 to 1.
    real3 direction = end - start;
    real3 inverse = safeReciprocal(direction);
    Shear shear = shearOf(direction);
    Walk walk = Walk(0u, 0u, 0u, 0u);
    bool finished = false, full = false;
    while (!finished) {
        descend(walk, start, inverse, 1.0, false);
        uint first = leafFirst(walk.node), stop = leafEnd(walk.node);
        bool isSphere = leafOfSpheres(walk.node);
        for (uint i = first; i < stop; ++i) {
            uvec4 r0 = texelFetch(primitives, int(3u * i)), r1 = texelFetch(primitives, int(3u * i + 1u)),
                  r2 = texelFetch(primitives, int(3u * i + 2u));
            real3 q0 = uintBitsToFloat(r0.xyz), q1 = uintBitsToFloat(r1.xyz), q2 = uintBitsToFloat(r2.xyz);
            uint rank = primitiveRank(r2);
            // Whether its ends are on two sides of the face, and whether it passes the face between.
            bool outside, crossed;
            real b1 = 0.0, b2 = 0.0;
            if (isSphere) {
                real radius2 = q1.x * q1.x;
                real3 f0 = start - q0, f1 = end - q0;
                outside = dot(f0, f0) >= radius2;
                crossed = outside != (dot(f1, f1) >= radius2);
            } else {
                outside = frontOf(start, q0, q1, q2);
                crossed = outside != frontOf(end, q0, q1, q2);
                ShearedTriangle at = sheared(shear, start, q0, q1, q2);
                real determinant = at.e0 + at.e1 + at.e2;
                bool positive = determinant > 0.0;
                crossed = crossed && determinant != 0.0 && insideEdge(at.e0, at.x1, at.y1, at.x2, at.y2, positive) &&
                          insideEdge(at.e1, at.x2, at.y2, at.x0, at.y0, positive) &&
                          insideEdge(at.e2, at.x0, at.y0, at.x1, at.y1, positive);
                b1 = at.e1 / determinant;
                b2 = at.e2 / determinant;
            }
            // Faces that are not there: of open surfaces, holes, what blends.
            if (closedOnly) crossed = crossed && rank != 0u && isClosedBody(rank);
            if (feature(FEATURE_ALPHA) && !isSphere && hasHoles(r0.w))
                crossed = crossed && !blends(r0.w) && coverageAt(r0.w, trianglePoint(i, b1, b2)) > 0.0;
            // A body more or less around the end; and the interface is that of the greatest rank.
            if (crossed) {
                if (rank != 0u) full = !crossFace(crossings.ranks, rank, outside) || full;
                uint weight = rank == 0u ? OPAQUE_RANK : rank;
                if (weight > crossings.rank) {
                    crossings.rank = weight;
                    crossings.primitive = i;
                    crossings.b1 = b1;
                    crossings.b2 = b2;
                }
            }
        }
        finished = isDone(walk);
        resume(walk);
    }
    countCutShort(walk, finished, source);
    if (full) countEvent(source, EVENT_STACK_OVERFLOW);
}
#endif
