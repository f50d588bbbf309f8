// What every stage begins with: the arithmetic, bindings of the job, push constants, specialisation, counters of
// events.
#ifndef ANTIPODE_COMMON
#define ANTIPODE_COMMON

#include "lib/real.glsl"
#include "shared/layout.h"

layout(constant_id = SPEC_FEATURES) const uint FEATURES = 0;
layout(constant_id = SPEC_LOBES) const uint LOBES = 0;
layout(constant_id = SPEC_TECHNIQUE) const uint TERMS = 0;
layout(constant_id = SPEC_VARIANT) const uint VARIANT = 0;
layout(constant_id = SPEC_LAYERS) const uint LAYERS = 0;

bool feature(uint bit) { return (FEATURES & bit) != 0; }
bool lobe(uint bit) { return (LOBES & bit) != 0; }
bool term(uint bit) { return (TERMS & bit) != 0; }
bool layer(uint bit) { return (LAYERS & bit) != 0; }

layout(local_size_x_id = SPEC_GROUP_SIZE) in;

layout(push_constant, std430) uniform Push { DispatchParameters push; };
layout(set = 0, binding = BIND_JOB, std430) readonly buffer Job { JobParameters job; };
layout(set = 0, binding = BIND_COUNTERS, std430) buffer Counters { uint counters[]; };

/// The invocation's index over a dispatch whose workgroups may be split into rows, as a row is at most 65,535 long.
uint flatIndex() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

/// The invocation's index over a dispatch of one row, with workgroups interleaved: drivers that give each core a
/// contiguous part of the grid then balance paths of unequal cost.
uint interleavedIndex() {
    const uint ways = 16;
    uint groups = gl_NumWorkGroups.x;
    uint perWay = groups / ways;
    uint group = gl_WorkGroupID.x;
    uint interleaved = group < perWay * ways ? (group % perWay) * ways + group / perWay : group;
    return interleaved * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

/// Counts an EVENT_* of a SOURCE_*.
void countEvent(uint source, uint kind) { atomicAdd(counters[COUNTER_EVENTS + source * EVENT_KINDS + kind], 1u); }

/// Relative luminance of linear RGB (ITU-R BT.709).
real luminance(real3 rgb) { return dot(rgb, real3(0.2126, 0.7152, 0.0722)); }

bool nonFinite(real3 value) { return any(isnan(value)) || any(isinf(value)); }

/// Counts a contribution or throughput that is not finite, or negative, or that was drawn with zero density: one event
/// at most, so that what it costs is one masked atomic.
void countInvalid(uint source, bool nonFinite_, bool negative, bool zeroPdf) {
    if (nonFinite_ || negative || zeroPdf)
        countEvent(source, nonFinite_ ? EVENT_NON_FINITE : negative ? EVENT_NEGATIVE : EVENT_ZERO_PDF);
}
#endif
