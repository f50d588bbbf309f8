// A vertex of a sub-path: where its ray arrived, and how it goes on. What the scatter, connect and merge stages start
// from. Stages ask a vertex for its cosines and never for a normal: a point in a medium has none, and answers 1.
#ifndef ANTIPODE_PATH_VERTEX
#define ANTIPODE_PATH_VERTEX
#include "lib/bsdf.glsl"
#include "lib/crop.glsl"
#include "lib/mis.glsl"
#include "lib/random.glsl"

struct PathVertex {
    Path path;  // densities as of arrival
    Surface surface;
    Bsdf bsdf;
    real3 back;  // unit, to where the sub-path came from
    bool valid;  // false: the ray met nothing
};

/// What converts between solid angle and area at the vertex.
real areaCosine(PathVertex v, real3 direction) { return abs(dot(direction, v.bsdf.ng)); }

/// What a BSDF is multiplied with: the shading cosine, on light paths (`adjoint`) with Veach's correction.
real scatterCosine(PathVertex v, real3 direction, bool adjoint) {
    return adjoint ? adjointCosine(v.bsdf, v.back, direction) : abs(dot(direction, v.bsdf.n));
}

/// Whether something can be sampled, connected or merged here.
bool scatters(PathVertex v) { return v.valid && !v.bsdf.specular && !v.bsdf.black; }

bool isDispersed(Path path) { return (path.flags & PATH_DISPERSED) != 0u; }
/// Whether what a sub-path carries on from the vertex depends on the wavelength, with FEATURE_DISPERSION.
bool isDispersed(PathVertex v) { return isDispersed(v.path) || v.bsdf.dispersive; }

/// The media before and beyond the interface that the path of this slot met.
uvec2 interfaceMedia(uint slot) {
    return uvec2(mediumOf(topRank(media[MEDIA_TEXELS * slot])), mediumOf(topRank(media[MEDIA_TEXELS * slot + 1u])));
}

/// The rank of the medium on the side of the vertex that a direction leaves to.
uint rankTowards(uint slot, PathVertex v, real3 direction) {
    uint side = dot(direction, v.bsdf.ng) >= 0.0 ? 0u : 1u;
    return topRank(media[MEDIA_TEXELS * slot + side]);
}

/// Notes the medium of the shadow ray that leaves the vertex in this direction.
void storeShadowMedium(uint slot, PathVertex v, real3 direction) {
    media[MEDIA_TEXELS * slot + 2u].x = rankTowards(slot, v, direction);
}

/// What is left of light over a distance from the vertex in this direction, with FEATURE_ABSORPTION.
real3 transmittanceTowards(uint slot, PathVertex v, real3 direction, real distance_) {
    return transmittance(rankTowards(slot, v, direction), distance_);
}

/// The vertex at which the path of this slot arrived.
PathVertex loadPathVertex(uint slot) {
    PathVertex v;
    v.path = loadPath(slot);
    Record hit = fetchRecord(hits, slot);
    uint primitive = recordTag(hit);
    real3 at = recordVector(hit);  // t, b1, b2
    v.valid = primitive != NO_INDEX;
    v.back = -v.path.direction;
    v.surface = surfaceAt(v.valid ? primitive : 0u, at.y, at.z, v.path.origin + at.x * v.path.direction);
    v.bsdf = loadBsdf(v.surface, v.back);
    if (feature(FEATURE_INTERFACES)) placeInterface(v.bsdf, v.back, interfaceMedia(slot));
    arrive(v.path, at.x, areaCosine(v, v.back));
    if (feature(FEATURE_ABSORPTION)) v.path.throughput *= transmittance(topRank(media[MEDIA_TEXELS * slot]), at.x);
    return v;
}

// The first vertex at which roulette may end a sub-path: before, it saves little and costs much where surfaces are
// dark.
const uint ROULETTE_START = 3;
// The greatest chance to survive it: lossless optics must not keep a path for ever.
const real GREATEST_SURVIVAL = 0.98;

// What may be lost of a path before it is cut. Cut by all that is lost, long paths in bright rooms make bidirectional
// images 1.5 times as noisy, and save little.
const real ROULETTE_THRESHOLD = 0.5;

/// Russian roulette (Arvo and Kirk, "Particle Transport and Image Synthesis", 1990) by what is left of the throughput
/// of a path that leaves a vertex. False where the path ends; one that goes on is worth more. The chance is part of no
/// density: weights add up to one over the techniques of a path whatever their densities leave out, as long as all
/// leave it out.
bool survivesRoulette(inout Path path, real u) {
    if (!term(TERM_ROULETTE) || pathLength(path) <= ROULETTE_START) return true;
    real left = max(path.throughput.x, max(path.throughput.y, path.throughput.z)) / path.lossless;
    real chance = min(left / ROULETTE_THRESHOLD, GREATEST_SURVIVAL);
    if (u >= chance) return false;
    path.throughput /= chance;
    return true;
}

/// Scatters a sub-path at its vertex and stores the ray that leaves. False where it ends: absorbed, by roulette, or
/// because it has `greatestEdges`. `wanted`: whether there is a path at all. `adjoint`: a light path. Events count for
/// `source`.
bool continuePath(PathVertex v, uint slot, uint greatestEdges, bool wanted, const bool adjoint, uint source) {
    Path path = v.path;
    uint edges = pathLength(path);
    uint id = push.pathBase + slot, stream = adjoint ? RANDOM_LIGHT : 0u;
    if (!adjoint) id = framePixel(id);
    real endDensity = adjoint ? lightEndDensity(path) : cameraEndDensity(path);

    // Sample the BSDF.
    real4 u = randomBlock(id, stream, edges, RANDOM_SCATTER);
    BsdfSample s = sampleBsdf(v.bsdf, v.back, adjoint, u.xyz);
    bool alive = wanted && s.valid && edges < greatestEdges;
    if (term(TERM_FIRST_DIFFUSE) && !adjoint) alive = alive && s.specular;

    // Throughput, and densities for the weights.
    path.throughput *= s.specular ? s.value : s.value * (scatterCosine(v, s.direction, adjoint) / s.pdf);
    bool transmitted = dot(s.direction, v.bsdf.ng) < 0.0;
    if (!adjoint && transmitted && lobe(LOBE_DIELECTRIC | LOBE_ROUGH_DIELECTRIC))
        path.lossless /= crossedIndex(v.bsdf) * crossedIndex(v.bsdf);  // as radiance
    scatterDensities(path, s.specular, endDensity, areaCosine(v, v.back), areaCosine(v, s.direction), s.pdf,
                     s.reversePdf, transmitted, crossedIndex(v.bsdf));

    // The ray that leaves.
    path.origin = leaveSurface(v.surface, s.direction);
    path.originPrimitive = v.surface.primitive;
    path.direction = s.direction;
    path.flags = (edges + 1u) | (s.specular ? path.flags & PATH_SPECULAR : 0u);
    if (feature(FEATURE_DISPERSION) && isDispersed(v)) path.flags |= PATH_DISPERSED;
    countInvalid(source, alive && (nonFinite(path.throughput) || nonFinite(s.direction) || isnan(path.dVCM + path.dVC)),
                 alive && any(lessThan(path.throughput, real3(0.0))), wanted && s.zeroPdf);
    alive = alive && max(path.throughput.x, max(path.throughput.y, path.throughput.z)) > 0.0;
    alive = alive && survivesRoulette(path, u.w);
    if (alive) storePath(slot, path);
    if (feature(FEATURE_INTERFACES) && alive && dot(s.direction, v.bsdf.ng) < 0.0)
        media[MEDIA_TEXELS * slot] = media[MEDIA_TEXELS * slot + 1u];
    return alive;
}
#endif
