// Points of a digital (t,s)-sequence in base 2, and their scrambling. Numbers are bit-reversed here: bit 0 is the first
// digit behind the point.
#ifndef ANTIPODE_SOBOL
#define ANTIPODE_SOBOL

/// Point `index` of four dimensions, reversed. Of the index, taken as a polynomial n over GF(2), a dimension's digits
/// are those of n in base x, x+1, x²+x+1 and x³+x+1 (Niederreiter 1988; Sobol' up to a relabelling of digits, which
/// scrambling makes equal). Two dimensions are a (0,2)-sequence, three a (1,3)- and all a (3,4)-sequence: by the
/// Chinese remainder theorem 2^m consecutive indices, aligned, take all residues of products of degree m. Digits in
/// base p come by halving: division by p^(2^k) = p(x^(2^k)), which has three terms.
uvec4 sobolPoint(uint index) {
    uint b = index;
    b ^= (b & 0xFFFF0000u) >> 16;
    b ^= (b & 0xFF00FF00u) >> 8;
    b ^= (b & 0xF0F0F0F0u) >> 4;
    b ^= (b & 0xCCCCCCCCu) >> 2;
    b ^= (b & 0xAAAAAAAAu) >> 1;

    uint c = index, part;
    part = c & 0xFF000000u, c ^= part >> 8 ^ part >> 16;
    part = c & 0x00FF0000u, c ^= part >> 8 ^ part >> 16;
    part = c & 0xF000F000u, c ^= part >> 4 ^ part >> 8;
    part = c & 0x0F000F00u, c ^= part >> 4 ^ part >> 8;
    part = c & 0xC0C0C0C0u, c ^= part >> 2 ^ part >> 4;
    part = c & 0x30303030u, c ^= part >> 2 ^ part >> 4;
    part = c & 0x88888888u, c ^= part >> 1 ^ part >> 2;
    part = c & 0x44444444u, c ^= part >> 1 ^ part >> 2;

    uint d = index;
    part = d & 0xFF000000u, d ^= part >> 16 ^ part >> 24;
    part = d & 0x00F00000u, d ^= part >> 8 ^ part >> 12;
    part = d & 0x000FF000u, d ^= part >> 8 ^ part >> 12;
    part = d & 0x00C00C00u, d ^= part >> 4 ^ part >> 6;
    part = d & 0xC03C03C0u, d ^= part >> 4 ^ part >> 6;
    part = d & 0x20820820u, d ^= part >> 2 ^ part >> 3;
    part = d & 0x18618618u, d ^= part >> 2 ^ part >> 3;
    return uvec4(index, b, c, d);
}

/// Owen's nested uniform scrambling of reversed numbers by a hash in which bits depend on lower ones alone (Laine and
/// Karras 2011; constants by Vegdahl, "Building a Better LK Hash", 2021).
uvec4 scramble(uvec4 x, uvec4 seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// A seed of its own from another.
uint mixed(uint x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    return x ^ x >> 15;
}
#endif
