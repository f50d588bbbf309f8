// Counter-based random numbers: a pure function of (seed, iteration, path, dimension), so that any iteration can be
// rendered anywhere and again. pcg4d: Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
#ifndef ANTIPODE_RANDOM
#define ANTIPODE_RANDOM

// Blocks of four dimensions; each sub-path vertex owns RANDOM_PER_VERTEX of them.
const uint RANDOM_PER_VERTEX = 32;
// Added on light paths. pcg4d does not part streams that differ in their highest bits alone.
const uint RANDOM_LIGHT = 0x9E3779B9u;
const uint RANDOM_START = 0;  // sub-path start: lens or light position and direction
const uint RANDOM_START_MORE = 1;
const uint RANDOM_SCATTER = 2;
const uint RANDOM_NEXT_EVENT = 3;
const uint RANDOM_NEXT_EVENT_MORE = 4;
const uint RANDOM_SPLAT = 5;
const uint RANDOM_ROUNDING = 6;  // of a sample to the film's whole numbers; the vertex is the pixel
const uint RANDOM_CONNECT = 8;   // one block for each connection

uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

/// Four independent random numbers of 32 bits for a block of a path's vertex.
uvec4 randomBits(uint path, uint stream, uint vertex, uint block) {
    return pcg4d(uvec4(path, stream + vertex * RANDOM_PER_VERTEX + block, push.randomKey0, push.randomKey1));
}

/// The same, uniform in [0, 1 − 2^-24]: 24 bits, whatever the precision.
real4 randomBlock(uint path, uint stream, uint vertex, uint block) {
    return real4(randomBits(path, stream, vertex, block) >> 8) * 5.9604644775390625e-8;
}

/// One of `count` things by 32 random bits: each has ⌊2^32/count⌋ of their values or one more.
uint randomIndex(uint bits, uint count) {
    uint index, rest;
    umulExtended(bits, count, index, rest);
    return index;
}
#endif
