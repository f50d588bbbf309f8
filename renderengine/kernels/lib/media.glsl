// What a path is in, where transparent bodies touch, nest or overlap (FEATURE_INTERFACES): the bodies around its ray's
// start by their ranks. The greatest is the medium there: Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced
// Images", JGT 7(2), 2002.
#ifndef ANTIPODE_MEDIA
#define ANTIPODE_MEDIA
#include "lib/transcendental.glsl"
#include "lib/wavelength.glsl"

layout(set = 0, binding = BIND_MEDIA, std430) buffer Media { uvec4 media[]; };
layout(set = 0, binding = BIND_BODIES) uniform usamplerBuffer bodies;

/// What a ray keeps off the surface that it leaves beyond the position's own error, so that whatever lies in the same
/// place as the surface, by rounding, is on the other side.
real interfaceRoom() { return uintBitsToFloat(texelFetch(bodies, 0).w); }
uint mediumOf(uint rank) { return texelFetch(bodies, int(rank)).y; }
bool isClosedBody(uint rank) { return texelFetch(bodies, int(rank)).w != 0u; }
/// Ranks of bodies that there are, where more than one texel of each is.
int rankCount() { return textureSize(bodies) / (feature(FEATURE_SCATTERING) ? 3 : 2); }
/// n_F − n_C of a medium, with FEATURE_DISPERSION.
real mediumSpread(uint medium) { return uintBitsToFloat(texelFetch(bodies, rankCount() + int(medium)).w); }
/// The index of refraction of a medium.
real mediumIndex(uint medium) {
    real ior = uintBitsToFloat(texelFetch(bodies, int(medium)).z);
    return feature(FEATURE_DISPERSION) ? indexAtWavelength(ior, mediumSpread(medium)) : ior;
}
/// Relative index of refraction of crossing from one medium into another.
real relativeIndex(uint from, uint to) { return mediumIndex(to) / mediumIndex(from); }
/// Whether it depends on the wavelength, with FEATURE_DISPERSION.
bool dispersesBetween(uint from, uint to) { return from != to && mediumSpread(from) + mediumSpread(to) > 0.0; }

/// Whether media take light away.
bool hasExtinction() { return feature(FEATURE_ABSORPTION | FEATURE_SCATTERING); }

/// What a unit of length absorbs and scatters in the medium of this rank, where hasExtinction().
real3 extinction(uint rank) { return uintBitsToFloat(texelFetch(bodies, rankCount() + int(rank)).xyz); }

/// What is left of light over a distance in the medium of this rank (Beer's law), where hasExtinction().
real3 transmittance(uint rank, real distance_) {
    real3 lost = extinction(rank);
    return real3(exp(-lost.x * distance_), exp(-lost.y * distance_), exp(-lost.z * distance_));
}

// ---- Media that scatter (FEATURE_SCATTERING) ---------------------------------------------------------------------

/// xyz: what a unit of length scatters; w: the phase function's mean cosine.
real4 mediumScattering(uint rank) { return uintBitsToFloat(texelFetch(bodies, 2 * rankCount() + int(rank))); }
bool mediumScatters(uint rank) { return any(greaterThan(mediumScattering(rank).xyz, real3(0.0))); }

/// Whether what stands in place of a primitive is a point in a medium, and of which rank.
bool isMediumPoint(uint primitive) {
    return feature(FEATURE_SCATTERING) && (primitive & ~GREATEST_RANK) == MEDIUM_POINT;
}
uint rankOfPoint(uint primitive) { return primitive & GREATEST_RANK; }

/// How far light flies in the medium of this rank until it is scattered or absorbed: by the extinction of one of the
/// three channels, each as likely as the others, so that the density is a mixture that no channel is missing from.
real sampleFlight(uint rank, real2 u) {
    real3 lost = extinction(rank);
    real of = u.y * 3.0 < 1.0 ? lost.x : u.y * 3.0 < 2.0 ? lost.y : lost.z;
    return mediumScatters(rank) && of > 0.0 ? min(-logOneMinus(u.x) / of, INFINITE_DISTANCE) : INFINITE_DISTANCE;
}

/// x: the chance that a flight is longer than a distance; y: its density there, per length.
real2 flightDensity(uint rank, real distance_) {
    real3 left = transmittance(rank, distance_);
    real2 density = real2(left.x + left.y + left.z, dot(extinction(rank), left)) / 3.0;
    return mediumScatters(rank) ? density : real2(1.0, 0.0);
}

/// The chance to fly over a distance to a surface; 1 where nothing scatters.
real passChance(uint rank, real distance_) {
    return feature(FEATURE_SCATTERING) ? flightDensity(rank, distance_).x : real(1.0);
}

/// Puts `to` in the place of one `from` in a set of eight ranks; false where there is none.
bool replaceRank(inout uvec4 ranks, uint from, uint to) {
    bvec4 low = equal(ranks & 0xFFFFu, uvec4(from)), high = equal(ranks >> 16, uvec4(from));
    uint bits = from ^ to;
    if (low.x)
        ranks.x ^= bits;
    else if (low.y)
        ranks.y ^= bits;
    else if (low.z)
        ranks.z ^= bits;
    else if (low.w)
        ranks.w ^= bits;
    else if (high.x)
        ranks.x ^= bits << 16;
    else if (high.y)
        ranks.y ^= bits << 16;
    else if (high.z)
        ranks.z ^= bits << 16;
    else if (high.w)
        ranks.w ^= bits << 16;
    else
        return false;
    return true;
}

/// Crosses a face of a body. In any order along a segment: a body that is left before it was entered is owed. False
/// where more than eight bodies would hold the point.
bool crossFace(inout uvec4 ranks, uint rank, bool entering) {
    uint undone = entering ? rank | RANK_OWED : rank, done_ = entering ? rank : rank | RANK_OWED;
    return replaceRank(ranks, undone, 0u) || replaceRank(ranks, 0u, done_);
}

/// Takes a body out that was left and never entered, or returns 0: faces that bound nothing, as of an open surface.
uint takeOwed(inout uvec4 ranks) {
    uint rank = 0u;
    for (uint i = 0u; i < 8u && rank == 0u; ++i) {
        uint entry = (ranks[i >> 1] >> ((i & 1u) * 16u)) & 0xFFFFu;
        if ((entry & RANK_OWED) != 0u) rank = entry;
    }
    if (rank != 0u) replaceRank(ranks, rank, 0u);
    return rank & GREATEST_RANK;
}

/// The rank of the medium.
uint topRank(uvec4 ranks) {
    uvec4 greatest = max(ranks & 0xFFFFu, ranks >> 16);
    return max(max(greatest.x, greatest.y), max(greatest.z, greatest.w));
}
#endif
