// Random numbers as a pure function of (seed, iteration, path, dimension), so that any iteration can be rendered
// anywhere and again. Hashes are pcg4d: Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
#ifndef ANTIPODE_RANDOM
#define ANTIPODE_RANDOM
#include "lib/sobol.glsl"

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
const uint RANDOM_FLIGHT = 7;    // how far the ray to the vertex flies in a medium
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

/// What tells this iteration from others: a set of samples has one key, and its iterations are neighbours.
uvec2 iterationKey() { return uvec2(push.randomKey0 + push.sampleIndex, push.randomKey1); }

/// Four independent random numbers of 32 bits for a block of a path's vertex.
uvec4 randomBits(uint path, uint stream, uint vertex, uint block) {
    return pcg4d(uvec4(path, stream + vertex * RANDOM_PER_VERTEX + block, iterationKey()));
}

/// The same block's point of an Owen-scrambled sequence: of camera paths the pixel's own, whose indices are the
/// iterations of a set; of light paths the iteration's, whose indices are the paths. Blocks are scrambled, and
/// shuffled, apart (padding: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020).
uvec4 scrambledPoint(uint path, uint stream, uint vertex, uint block) {
    bool light = stream == RANDOM_LIGHT;
    uint index = light ? path : push.sampleIndex;
    uvec4 seeds =
        pcg4d(uvec4(light ? 0u : path, stream + vertex * RANDOM_PER_VERTEX + block, push.randomKey0, push.randomKey1));
    uint shuffled = bitfieldReverse(scramble(uvec4(bitfieldReverse(index)), uvec4(mixed(seeds.x ^ seeds.w))).x);
    return bitfieldReverse(scramble(sobolPoint(shuffled), seeds));
}

/// Four random numbers of a block, uniform in [0, 1 − 2^-24]: 24 bits, whatever the precision. With TERM_SOBOL
/// stratified over a sequence, the first two best.
real4 randomBlock(uint path, uint stream, uint vertex, uint block) {
    uvec4 bits =
        term(TERM_SOBOL) ? scrambledPoint(path, stream, vertex, block) : randomBits(path, stream, vertex, block);
    return real4(bits >> 8) * 5.9604644775390625e-8;
}

/// The same for a choice by the first two numbers and a point by the last two, which are stratified best.
real4 randomChoiceAndPoint(uint path, uint stream, uint vertex, uint block) {
    real4 u = randomBlock(path, stream, vertex, block);
    return term(TERM_SOBOL) ? u.zwxy : u;
}

/// One of `count` things by 32 random bits: each has ⌊2^32/count⌋ of their values or one more.
uint randomIndex(uint bits, uint count) {
    uint index, rest;
    umulExtended(bits, count, index, rest);
    return index;
}
#endif
