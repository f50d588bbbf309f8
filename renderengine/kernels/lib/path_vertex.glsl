// A vertex of a sub-path: where its ray arrived, and how it goes on. What the scatter, connect and merge stages start
// from. Stages ask a vertex for what it scatters, its cosines and its sides, and never for a BSDF or a normal: a point
// in a medium, with FEATURE_SCATTERING, has none.
#ifndef ANTIPODE_PATH_VERTEX
#define ANTIPODE_PATH_VERTEX
#include "lib/bsdf.glsl"
#include "lib/crop.glsl"
#include "lib/mis.glsl"
#include "lib/phase.glsl"
#include "lib/random.glsl"

struct PathVertex {
    Path path;        // densities as of arrival
    real endDensity;  // path.dVCM times the sample count of the technique that it stands for
    real3 position;
    uint primitive;  // or a MEDIUM_POINT, of which surface and bsdf say nothing
    Surface surface;
    Bsdf bsdf;
    real3 back;    // unit, to where the sub-path came from
    bool adjoint;  // a light path
    bool valid;    // false: the ray met nothing
};

/// The vertex of a sub-path that came from `back`; `mediaAcross`: before and beyond it, with FEATURE_INTERFACES.
PathVertex surfaceVertex(Surface surface, real3 back, uvec2 mediaAcross, bool adjoint) {
    PathVertex v;
    v.position = surface.position;
    v.primitive = surface.primitive;
    v.surface = surface;
    v.back = back;
    v.bsdf = loadBsdf(surface, back);
    if (feature(FEATURE_INTERFACES)) placeInterface(v.bsdf, back, mediaAcross);
    v.adjoint = adjoint;
    v.valid = true;
    return v;
}

/// Makes a vertex a point in the medium that `primitive` names.
void placeInMedium(inout PathVertex v, real3 position, uint primitive) {
    v.position = position;
    v.primitive = primitive;
    v.surface.light = NO_INDEX;
}

bool inMedium(const PathVertex v) { return isMediumPoint(v.primitive); }

/// What the vertex scatters between where the sub-path came from and a direction, without a cosine: 0 for delta lobes.
/// In a medium per length. pdf: per solid angle of going on in the direction; reversePdf: of the other way.
real3 evalVertex(const PathVertex v, real3 direction, out real pdf, out real reversePdf) {
    real3 f = evalBsdf(v.bsdf, v.back, direction, v.adjoint, pdf, reversePdf);
    if (inMedium(v)) {
        real4 scattering = mediumScattering(rankOfPoint(v.primitive));
        pdf = reversePdf = phaseFunction(v.back, direction, scattering.w);
        f = scattering.xyz * pdf;
    }
    return f;
}

/// A direction to go on to, as sampleBsdf has it.
BsdfSample sampleVertex(const PathVertex v, real3 u) {
    BsdfSample s = sampleBsdf(v.bsdf, v.back, v.adjoint, u);
    if (inMedium(v)) {
        real4 scattering = mediumScattering(rankOfPoint(v.primitive));
        s.direction = samplePhase(v.back, scattering.w, u.xy);
        s.pdf = s.reversePdf = phaseFunction(v.back, s.direction, scattering.w);
        s.value = scattering.xyz * s.pdf;
        s.specular = s.zeroPdf = false;
        s.valid = true;
    }
    return s;
}

/// What converts between solid angle and area at the vertex, in a medium volume.
real areaCosine(const PathVertex v, real3 direction) { return inMedium(v) ? 1.0 : abs(dot(direction, v.bsdf.ng)); }

/// The same of a ray that comes from a direction, over a distance in the medium of this rank: times the chance, or at a
/// point in the medium the density per length, with which it flies just so far.
real arrivalDensity(const PathVertex v, real3 direction, uint medium, real distance_) {
    real cosine = areaCosine(v, direction);
    if (!feature(FEATURE_SCATTERING)) return cosine;
    real2 flight = flightDensity(medium, distance_);
    return cosine * (inMedium(v) ? flight.y : flight.x);
}

/// What evalVertex is multiplied with: the shading cosine, on light paths with Veach's correction.
real scatterCosine(const PathVertex v, real3 direction) {
    if (inMedium(v)) return 1.0;
    return v.adjoint ? adjointCosine(v.bsdf, v.back, direction) : abs(dot(direction, v.bsdf.n));
}

/// What light that a merge brings from a direction gains at the vertex.
real mergeGain(const PathVertex v, real3 direction) {
    return feature(FEATURE_ATTRIBUTES) ? shadingGain(v.bsdf, direction) : 1.0;
}

/// Whether a sub-path can go on from here at all.
bool goesOn(const PathVertex v) { return v.valid && (inMedium(v) || !v.bsdf.black); }

/// Whether something can be sampled or connected here.
bool scatters(const PathVertex v) { return goesOn(v) && (inMedium(v) || !v.bsdf.specular); }

/// Whether light vertices can be merged here: those on surfaces, with a vertex on a surface.
bool merges(const PathVertex v) { return scatters(v) && !inMedium(v); }

/// Whether the sub-path came from the side that the vertex scatters to. By its shading normal a surface can face away.
bool facesBack(const PathVertex v) { return inMedium(v) || dot(v.back, v.bsdf.n) > 0.0; }

/// Whether a direction leads through the surface, to the side that the sub-path did not come from.
bool passesThrough(const PathVertex v, real3 direction) { return !inMedium(v) && dot(direction, v.bsdf.ng) < 0.0; }

/// Where a ray that leaves the vertex in a direction starts.
real3 leaveVertex(const PathVertex v, real3 direction) {
    return inMedium(v) ? v.position : leaveSurface(v.surface, direction);
}

bool isDispersed(Path path) { return (path.flags & PATH_DISPERSED) != 0u; }
/// Whether what a sub-path carries on from the vertex depends on the wavelength, with FEATURE_DISPERSION.
bool isDispersed(const PathVertex v) { return isDispersed(v.path) || (!inMedium(v) && v.bsdf.dispersive); }

/// The media before and beyond the interface that the path of this slot met.
uvec2 interfaceMedia(uint slot) {
    return uvec2(mediumOf(topRank(media[MEDIA_TEXELS * slot])), mediumOf(topRank(media[MEDIA_TEXELS * slot + 1u])));
}

/// The rank of the medium on the side of the vertex that a direction leaves to; 0 without FEATURE_INTERFACES.
uint mediumTowards(uint slot, const PathVertex v, real3 direction) {
    if (!feature(FEATURE_INTERFACES)) return 0u;
    return topRank(media[MEDIA_TEXELS * slot + (passesThrough(v, direction) ? 1u : 0u)]);
}

/// Notes the rank of the medium of the slot's shadow ray, with FEATURE_INTERFACES.
void storeShadowMedium(uint slot, uint medium) { media[MEDIA_TEXELS * slot + 2u].x = medium; }

/// What the medium of this rank, in which the last segment lay, leaves of a path, where hasExtinction().
void passMedium(inout PathVertex v, uint medium, real distance_) {
    v.path.throughput *= transmittance(medium, distance_);
    if (!feature(FEATURE_SCATTERING)) return;
    real2 flight = flightDensity(medium, distance_);
    real here = inMedium(v) ? flight.y : flight.x;
    v.path.throughput /= here;
    passMedium(v.path, here, isMediumPoint(v.path.originPrimitive) ? flight.y : flight.x);
    if (inMedium(v)) v.path.flags |= PATH_IN_MEDIUM;
}

/// The vertex at which the path of this slot arrived; `adjoint`: a light path.
PathVertex loadPathVertex(uint slot, const bool adjoint) {
    Path path = loadPath(slot);
    Record hit = fetchRecord(hits, slot);
    uint primitive = recordTag(hit);
    real3 at = recordVector(hit);  // t, b1, b2
    bool valid = primitive != NO_INDEX, point = isMediumPoint(primitive);
    real3 end = path.origin + at.x * path.direction;
    Surface surface = surfaceAt(valid && !point ? primitive : 0u, at.y, at.z, end);
    uvec2 mediaAcross = feature(FEATURE_INTERFACES) ? interfaceMedia(slot) : uvec2(0u);
    PathVertex v = surfaceVertex(surface, -path.direction, mediaAcross, adjoint);
    if (point) placeInMedium(v, end, primitive);
    v.valid = valid;
    v.path = path;
    arrive(v.path, at.x, areaCosine(v, v.back));
    if (hasExtinction()) passMedium(v, point ? rankOfPoint(primitive) : topRank(media[MEDIA_TEXELS * slot]), at.x);
    v.endDensity = adjoint ? lightEndDensity(v.path) : cameraEndDensity(v.path);
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
/// because it has `greatestEdges`. `wanted`: whether there is a path at all. Events count for `source`.
bool continuePath(const PathVertex v, uint slot, uint greatestEdges, bool wanted, uint source) {
    Path path = v.path;
    uint edges = pathLength(path);
    uint id = push.pathBase + slot, stream = v.adjoint ? RANDOM_LIGHT : 0u;
    if (!v.adjoint) id = framePixel(id);

    // Sample a direction.
    real4 u = randomBlock(id, stream, edges, RANDOM_SCATTER);
    BsdfSample s = sampleVertex(v, u.xyz);
    bool alive = wanted && s.valid && edges < greatestEdges;
    // Camera paths that end where something scatters go on through media where only surfaces take from light paths.
    if (term(TERM_FIRST_DIFFUSE) && !v.adjoint) alive = alive && (s.specular || (inMedium(v) && !term(TERM_SPLAT)));

    // Throughput, and densities for the weights.
    path.throughput *= s.specular ? s.value : s.value * (scatterCosine(v, s.direction) / s.pdf);
    bool transmitted = passesThrough(v, s.direction);
    if (!v.adjoint && transmitted && lobe(LOBE_DIELECTRIC | LOBE_ROUGH_DIELECTRIC))
        path.lossless /= crossedIndex(v.bsdf) * crossedIndex(v.bsdf);  // as radiance
    scatterDensities(path, s.specular, v.endDensity, areaCosine(v, v.back), areaCosine(v, s.direction), s.pdf,
                     s.reversePdf, transmitted, crossedIndex(v.bsdf));

    // The ray that leaves.
    path.origin = leaveVertex(v, s.direction);
    path.originPrimitive = v.primitive;
    path.direction = s.direction;
    path.flags = (edges + 1u) | (s.specular || inMedium(v) ? path.flags & PATH_SPECULAR : 0u);
    if (feature(FEATURE_DISPERSION) && isDispersed(v)) path.flags |= PATH_DISPERSED;
    countInvalid(source, alive && (nonFinite(path.throughput) || nonFinite(s.direction) || isnan(path.dVCM + path.dVC)),
                 alive && any(lessThan(path.throughput, real3(0.0))), wanted && s.zeroPdf);
    alive = alive && max(path.throughput.x, max(path.throughput.y, path.throughput.z)) > 0.0;
    alive = alive && survivesRoulette(path, u.w);
    if (alive) storePath(slot, path);
    if (feature(FEATURE_INTERFACES) && alive && transmitted)
        media[MEDIA_TEXELS * slot] = media[MEDIA_TEXELS * slot + 1u];
    return alive;
}
#endif
