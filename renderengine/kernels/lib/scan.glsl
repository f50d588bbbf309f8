// The array of counts that become exclusive prefix sums.
#ifndef ANTIPODE_SCAN
#define ANTIPODE_SCAN
layout(set = 0, binding = BIND_SCAN, std430) buffer Scan { uint scan[]; };
uint chunkCount(uint slots) { return (slots + COMPACT_CHUNK - 1u) / COMPACT_CHUNK; }
#endif
