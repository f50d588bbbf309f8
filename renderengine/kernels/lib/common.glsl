// What every stage begins with: the arithmetic type, bindings of the job, push constants, specialisation.
#ifndef ANTIPODE_COMMON
#define ANTIPODE_COMMON

#include "shared/layout.h"

#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4

const real PI = 3.14159265358979323846;
const real INFINITE_DISTANCE = 1e29;  // beyond any scene (±1e18), before the boxes of empty BVH slots (1e30)
const real UNIT_ROUNDOFF = 5.9604645e-8;  // 2^-24

/// Higham's bound on the relative error of n rounded operations.
real errorGamma(real n) { return n * UNIT_ROUNDOFF / (1.0 - n * UNIT_ROUNDOFF); }

layout(constant_id = SPEC_FEATURES) const uint FEATURES = 0;
layout(constant_id = SPEC_TECHNIQUE) const uint TERMS = 0;
layout(constant_id = SPEC_VARIANT) const uint VARIANT = 0;

bool feature(uint bit) { return (FEATURES & bit) != 0; }
bool term(uint bit) { return (TERMS & bit) != 0; }

layout(local_size_x_id = SPEC_GROUP_SIZE) in;

layout(push_constant, std430) uniform Push { DispatchParameters push; };
layout(set = 0, binding = BIND_JOB, std430) readonly buffer Job { JobParameters job; };
layout(set = 0, binding = BIND_COUNTERS, std430) buffer Counters { uint counters[]; };

/// The invocation's index over a dispatch whose workgroups may be split into rows, as a row is at most 65,535 long.
uint flatIndex() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

/// The invocation's index over a dispatch of one row, with workgroups interleaved: drivers that give each core a contiguous
/// part of the grid then balance paths of unequal cost.
uint interleavedIndex() {
    const uint ways = 16;
    uint groups = gl_NumWorkGroups.x;
    uint perWay = groups / ways;
    uint group = gl_WorkGroupID.x;
    uint interleaved = group < perWay * ways ? (group % perWay) * ways + group / perWay : group;
    return interleaved * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

void countEvent(uint counter) { atomicAdd(counters[counter], 1); }
#endif
