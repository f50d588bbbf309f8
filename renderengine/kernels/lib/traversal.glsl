// Closest-hit and any-hit traversal of the BVH4, watertight for triangles. One call site per kernel: the code is large
// and some drivers compile each inlined copy at a cost that grows faster than their number.
#ifndef ANTIPODE_TRAVERSAL
#define ANTIPODE_TRAVERSAL

layout(constant_id = SPEC_STACK_DEPTH) const uint STACK_DEPTH = 64;
layout(set = 0, binding = BIND_NODES) uniform usamplerBuffer bvhNodes;
#include "lib/alpha.glsl"
#include "lib/scene_data.glsl"

// In shared memory because private arrays spill to memory that every lane strides through.
shared uint traversalStack[STACK_DEPTH * gl_WorkGroupSize.x];

struct Hit {
    real t, b1, b2;  // distance in units of the direction's length, barycentrics of p1 and p2
    uint primitive;  // NO_INDEX: none
};

/// Component-wise reciprocal that stays finite: a zero component becomes huge, so that 0·∞ never makes a NaN.
real3 safeReciprocal(real3 d) {
    const real tiny = 1e-37;
    return 1.0 / mix(d, mix(real3(-tiny), real3(tiny), greaterThanEqual(d, real3(0.0))), lessThan(abs(d), real3(tiny)));
}

real3 permute(real3 v, uint axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }

/// A ray's direction as Woop, Benthin and Wald (2013) need it: the axis that it follows most becomes z, and a shear
/// lays the ray along it.
struct Shear {
    uint axis;
    real x, y, z;
};

Shear shearOf(real3 direction) {
    real3 a = abs(direction);
    uint axis = a.x > a.y ? (a.x > a.z ? 0u : 2u) : (a.y > a.z ? 1u : 2u);
    real3 d = permute(direction, axis);
    real z = 1.0 / d.z;
    return Shear(axis, d.x * z, d.y * z, z);
}

/// A triangle where the ray is the z axis.
struct ShearedTriangle {
    real x0, y0, x1, y1, x2, y2;  // corners, in units of length
    real z0, z1, z2;              // before shearing along z
    real e0, e1, e2;              // edge functions: twice the signed areas that the ray parts the triangle into
};

/// The same for every triangle that shares a corner or an edge: that is what makes edges watertight.
ShearedTriangle sheared(Shear shear, real3 origin, real3 q0, real3 q1, real3 q2) {
    real3 p0 = permute(q0 - origin, shear.axis);
    real3 p1 = permute(q1 - origin, shear.axis);
    real3 p2 = permute(q2 - origin, shear.axis);
    precise real x0 = p0.x - shear.x * p0.z, y0 = p0.y - shear.y * p0.z;
    precise real x1 = p1.x - shear.x * p1.z, y1 = p1.y - shear.y * p1.z;
    precise real x2 = p2.x - shear.x * p2.z, y2 = p2.y - shear.y * p2.z;
    precise real e0 = x2 * y1 - y2 * x1;
    precise real e1 = x0 * y2 - y0 * x2;
    precise real e2 = x1 * y0 - y1 * x0;
    return ShearedTriangle(x0, y0, x1, y1, x2, y2, p0.z, p1.z, p2.z, e0, e1, e2);
}

/// A walk over the tree. Work that waits is kept as groups: a node and a bit for each of its children that the ray has
/// still to enter. The current group is in a register, so that a node costs one access to the stack, not one for each
/// child.
struct Walk {
    uint node;  // to visit next
    uint group;
    uint top, deepest;  // of the stack: where it is, and how far it was wanted to go
};

const uint NO_NODE = 0xFFFFFFFFu;  // also what an empty child refers to

/// Goes down to the next leaf whose box origin + t·direction meets with 0 < t < tMax; leaves NO_NODE where there is
/// none before the work that waits.
void descend(inout Walk walk, real3 origin, real3 inverse, real tMax, bool nearestFirst) {
    const real widen = 1.0 + 16.0 * UNIT_ROUNDOFF;  // 6 for the boxes, 10 for the triangle test
    uint lane = gl_LocalInvocationID.x;
    while ((walk.node & 0x80000000u) == 0u) {
        int at = int(walk.node * 7u);
        real4 x0 = uintBitsToFloat(texelFetch(bvhNodes, at)), x1 = uintBitsToFloat(texelFetch(bvhNodes, at + 1));
        real4 y0 = uintBitsToFloat(texelFetch(bvhNodes, at + 2)), y1 = uintBitsToFloat(texelFetch(bvhNodes, at + 3));
        real4 z0 = uintBitsToFloat(texelFetch(bvhNodes, at + 4)), z1 = uintBitsToFloat(texelFetch(bvhNodes, at + 5));
        uvec4 child = texelFetch(bvhNodes, at + 6);
        x0 = (x0 - origin.x) * inverse.x;
        x1 = (x1 - origin.x) * inverse.x;
        y0 = (y0 - origin.y) * inverse.y;
        y1 = (y1 - origin.y) * inverse.y;
        z0 = (z0 - origin.z) * inverse.z;
        z1 = (z1 - origin.z) * inverse.z;
        real4 near = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), real4(0.0)));
        real4 far = min(min(max(x0, x1), max(y0, y1)), max(z0, z1)) * widen;
        bvec4 inside = lessThanEqual(near, min(far, real4(tMax)));
        uint waiting = (inside.x ? 1u : 0u) | (inside.y ? 2u : 0u) | (inside.z ? 4u : 0u) | (inside.w ? 8u : 0u);
        // The nearest child is next, or any where any hit will do; the others form a group.
        uint pick = inside.x ? 0u : inside.y ? 1u : inside.z ? 2u : 3u;
        if (nearestFirst) {
            near = mix(real4(INFINITE_DISTANCE), near, inside);
            real nearest = min(min(near.x, near.y), min(near.z, near.w));
            pick = near.x == nearest ? 0u : near.y == nearest ? 1u : near.z == nearest ? 2u : 3u;
        }
        uint next = waiting == 0u ? NO_NODE
                    : pick == 0u  ? child.x
                    : pick == 1u  ? child.y
                    : pick == 2u  ? child.z
                                  : child.w;
        waiting &= ~(1u << pick);
        if (waiting != 0u) {
            if (walk.group != 0u) {
                if (walk.top < STACK_DEPTH) traversalStack[walk.top * gl_WorkGroupSize.x + lane] = walk.group;
                walk.top++;
                walk.deepest = max(walk.deepest, walk.top);
            }
            walk.group = (walk.node << 4) | waiting;
        }
        walk.node = next;
    }
}

uint leafFirst(uint node) { return node & 0x07FFFFFFu; }
uint leafEnd(uint node) { return leafFirst(node) + (node == NO_NODE ? 0u : ((node >> 27) & 7u) + 1u); }
bool leafOfSpheres(uint node) { return (node & 0x40000000u) != 0u; }

bool isDone(Walk walk) { return walk.group == 0u && walk.top == 0u; }

/// Goes on with the work that waits.
void resume(inout Walk walk) {
    uint lane = gl_LocalInvocationID.x;
    if (walk.group == 0u && walk.top > 0u) {
        walk.top--;
        if (walk.top < STACK_DEPTH) walk.group = traversalStack[walk.top * gl_WorkGroupSize.x + lane];
    }
    uvec4 child = texelFetch(bvhNodes, int((walk.group >> 4) * 7u + 6u));
    uint pick = uint(findLSB(walk.group & 15u));
    walk.node = pick == 0u ? child.x : pick == 1u ? child.y : pick == 2u ? child.z : child.w;
    if (walk.group == 0u) walk.node = NO_NODE;  // what the stack had no room for is not visited
    walk.group &= walk.group - 1u;
    if ((walk.group & 15u) == 0u) walk.group = 0u;
}

/// Left with work undone: a driver's loop limit cut the walk short, and its result is not to be trusted.
void countCutShort(Walk walk, bool finished, uint source) {
    if (!finished) countEvent(source, EVENT_LOOP_LIMIT);
    if (walk.deepest > STACK_DEPTH) countEvent(source, EVENT_STACK_OVERFLOW);
}

/// Whether a point is on a triangle's front side.
bool frontOf(real3 point, real3 p0, real3 p1, real3 p2) {
    precise real3 normal = cross(p1 - p0, p2 - p0);
    precise real side = dot(normal, point - p0);
    return side >= 0.0;
}

/// Nearest hit of origin + t·direction with 0 < t < tMax. The primitives `skip0` and `skip1` that the segment starts
/// and ends on are planar or handled by sign, and never hit themselves. anyHit: stops at the first one found. `source`
/// is what its events count for. With FEATURE_INTERFACES faces of a lower rank than `mediumRank` are not there: what
/// they bound is overlapped by the medium. Triangles: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT
/// 2(1), 2013. Boxes: far distances widened after Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013. Spheres: Haines et
/// al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019.
Hit intersect(real3 origin, real3 direction, real tMax, uint skip0, uint skip1, bool anyHit, uint source,
              uint mediumRank) {
    Hit hit = Hit(tMax, 0.0, 0.0, NO_INDEX);
    real3 inverse = safeReciprocal(direction);

    Shear shear = shearOf(direction);

    uvec4 segment = uvec4(0u);
    if (feature(FEATURE_BLENDING)) segment = segmentBits(origin, direction);

    Walk walk = Walk(0u, 0u, 0u, 0u);
    bool finished = false;
    while (!finished) {
        descend(walk, origin, inverse, hit.t, !anyHit);
        uint first = leafFirst(walk.node), end = leafEnd(walk.node);
        bool isSphere = leafOfSpheres(walk.node);
        if (feature(FEATURE_TRIANGLES)) {
            uint stop = isSphere ? first : end;
            for (uint i = first; i < stop; ++i) {
                uvec4 r0 = texelFetch(primitives, int(3u * i)), r1 = texelFetch(primitives, int(3u * i + 1u)),
                      r2 = texelFetch(primitives, int(3u * i + 2u));
                real3 q0 = uintBitsToFloat(r0.xyz), q1 = uintBitsToFloat(r1.xyz), q2 = uintBitsToFloat(r2.xyz);
                ShearedTriangle at = sheared(shear, origin, q0, q1, q2);
                // Whether the ray passes inside all edges, and how far off.
                real determinant = at.e0 + at.e1 + at.e2;
                bool covered = (min(at.e0, min(at.e1, at.e2)) >= 0.0 || max(at.e0, max(at.e1, at.e2)) <= 0.0) &&
                               determinant != 0.0;
                real s0 = at.e0 * at.z0, s1 = at.e1 * at.z1, s2 = at.e2 * at.z2;
                real scaled = (s0 + s1 + s2) * shear.z;
                real inverseDeterminant = 1.0 / determinant;
                real t = scaled * inverseDeterminant;
                // A distance that its own rounding could have made is no hit: the primitive lies at the origin.
                real bound = 8.0 * UNIT_ROUNDOFF * (abs(s0) + abs(s1) + abs(s2)) * abs(shear.z * inverseDeterminant);
                bool meets = t > bound && t < hit.t;
                if (feature(FEATURE_INTERFACES) && primitiveRank(r2) != 0u) {
                    // Which side of the face a point is on is decided in one way everywhere, so that none is passed
                    // without being met or crossed.
                    bool front = frontOf(origin, q0, q1, q2);
                    bool ahead = anyHit ? front != frontOf(origin + direction * tMax, q0, q1, q2)
                                        : front == (dot(cross(q1 - q0, q2 - q0), direction) < 0.0);
                    meets = ahead && t < hit.t && primitiveRank(r2) >= mediumRank;
                    t = max(t, 0.0);
                }
                // The nearest so far, unless it is a hole.
                if (covered && meets && i != skip0 && i != skip1) {
                    real b1 = at.e1 * inverseDeterminant, b2 = at.e2 * inverseDeterminant;
                    if (!feature(FEATURE_ALPHA) || !hasHoles(r0.w) ||
                        meetsCovered(segment, i, coverageAt(r0.w, trianglePoint(i, b1, b2))))
                        hit = Hit(t, b1, b2, i);
                }
            }
        }
        if (feature(FEATURE_SPHERES)) {
            uint stop = isSphere ? end : first;
            for (uint i = first; i < stop; ++i) {
                uvec4 r0 = texelFetch(primitives, int(3u * i));
                real3 center = uintBitsToFloat(r0.xyz);
                real radius = uintBitsToFloat(texelFetch(primitives, int(3u * i + 1u)).x);
                bool present = true;
                if (feature(FEATURE_INTERFACES)) {
                    uint rank = primitiveRank(texelFetch(primitives, int(3u * i + 2u)));
                    present = rank == 0u || rank >= mediumRank;
                }
                // Both roots of the quadratic equation; the one ahead, from within the farther.
                real3 f = origin - center;
                real dd = dot(direction, direction);
                real b = -dot(f, direction);
                real3 l = f + direction * (b / dd);  // from the centre to the ray's closest point
                real discriminant = radius * radius - dot(l, l);
                real c = dot(f, f) - radius * radius;
                real q = b + (b >= 0.0 ? 1.0 : -1.0) * sqrt(max(dd * discriminant, 0.0));
                real t0 = c / q, t1 = q / dd;
                real lower = min(t0, t1), upper = max(t0, t1);
                real t = lower > 0.0 ? lower : upper;
                if (feature(FEATURE_BLENDING)) {
                    real coverage = blends(r0.w) ? coverageAt(r0.w, TexturePoint(real2(0.0), i, 0.0, 0.0)) : 1.0;
                    if (t == lower && !meetsCovered(segment, i, coverage)) t = upper;
                    if (t == upper && !meetsCovered(segment, ~i, coverage)) t = 0.0;
                }
                if (discriminant >= 0.0 && q != 0.0 && t > 0.0 && t < hit.t && present) hit = Hit(t, 0.0, 0.0, i);
            }
        }
        finished = (anyHit && hit.primitive != NO_INDEX) || isDone(walk);
        resume(walk);
    }
    countCutShort(walk, finished, source);
    return hit;
}
#endif
