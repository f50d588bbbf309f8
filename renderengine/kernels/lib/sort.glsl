// Radix sort of (bucket, vertex) pairs, SORT_DIGIT_BITS a pass, stable: equal buckets keep the order of the light
// paths.
#ifndef ANTIPODE_SORT
#define ANTIPODE_SORT
layout(set = 0, binding = BIND_SORT_KEYS, std430) buffer SortKeys { uvec2 sortKeys[]; };
uint sortSource() { return (push.stageIndex & 1u) * push.vertexCapacity; }
uint sortTarget() { return push.vertexCapacity - sortSource(); }
uint sortDigit(uint key) { return (key >> (SORT_DIGIT_BITS * push.stageIndex)) & (SORT_DIGITS - 1u); }
uint sortChunks() { return (push.vertexCount + SORT_CHUNK - 1u) / SORT_CHUNK; }
// A private array would live in memory that all lanes stride through.
shared uint digitCount[SORT_DIGITS * gl_WorkGroupSize.x];
uint digitAt(uint digit) { return digit * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
#endif
