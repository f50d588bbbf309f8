// Multiple importance sampling over all techniques, balance heuristic, every technique weighted by its sample count:
// emitter hit and next event by 0 or 1, splat by N or 0, connections by κ, merges by η = πr²N.
// dVCM is kept without a count; where it stands for a technique, an end count supplies it: next event or splat next to
// a sub-path's end, connection further on. Equations: Georgiev 2012. All in terms of densities alone, so that tests can
// hold the same lines against an enumeration of all techniques.
#ifndef ANTIPODE_MIS
#define ANTIPODE_MIS
#include "lib/state.glsl"

// ---- The recursion along a sub-path ----------------------------------------------------------------------------

/// A light sub-path on its first segment (eq. 31–33), from what sampleEmission says of its start: P_dir/P_emit, to
/// which lightEndDensity() gives the count of next event, and cosine/P_emit, which stands for the emitter hit.
void startLightPath(inout Path path, real dVCM, real dVC) {
    path.dVCM = dVCM;
    path.dVC = dVC * push.hitCount;
}

/// A camera sub-path on its first segment (eq. 31–33). pdf: of its direction per solid angle. No light path meets the
/// lens by chance, so that dVC is 0.
void startCameraPath(inout Path path, real pdf) {
    path.dVCM = 1.0 / pdf;
    path.dVC = 0.0;
}

/// Densities of the last segment become area densities at the vertex that it reaches.
void arrive(inout Path path, real distance_, real cosGeometric) {
    if ((path.flags & PATH_FROM_INFINITY) == 0u) path.dVCM *= distance_ * distance_;
    path.flags &= ~PATH_FROM_INFINITY;
    real inverse = 1.0 / cosGeometric;
    path.dVCM *= inverse;
    path.dVC *= inverse;
}

/// A last segment through a medium that scatters, with FEATURE_SCATTERING: a ray that goes so far ends on a surface
/// with the chance P not to be scattered before, and at a point in the medium with the flight's density p per length.
/// So the density at a vertex, per area or, in a medium, per volume, is that of empty space times P or p of the segment
/// before it: `here` of this vertex, and `before` the same of the other way along the segment, which ends at the vertex
/// before. Eq. 31–36 hold with these densities, cosines being 1 at points in media: dVCM, one over the density of this
/// vertex, is divided by `here`; in dVC, of which each segment holds the ratio of its two ways, distances cancel and
/// before/here stays.
void passMedium(inout Path path, real here, real before) {
    path.dVCM /= here;
    path.dVC *= before / here;
}

/// What merging counts at the vertex of a sub-path: nothing is merged at points in media.
real mergeCountAt(Path path) {
    return feature(FEATURE_SCATTERING) && (path.flags & PATH_IN_MEDIUM) != 0u ? 0.0 : push.mergeCount;
}

/// dVCM of a light or camera sub-path at its vertex, times the sample count of the technique that joins the vertex to
/// the one before it.
real lightEndDensity(Path path) {
    return (pathLength(path) == 1u ? push.nextEventCount : push.connectCount) * path.dVCM;
}
real cameraEndDensity(Path path) { return (pathLength(path) == 1u ? push.splatCount : push.connectCount) * path.dVCM; }

/// All techniques that would end the sub-path at its vertex or further back, per unit of the density with which the
/// other side would sample the vertex: merging there, ending there, or coming by with `reversePdf`.
real furtherTechniques(Path path, real endDensity, real reversePdf) {
    return mergeCountAt(path) + endDensity + reversePdf * path.dVC;
}

/// Leaving a vertex through a delta lobe (eq. 53–55). The densities of the two ways along a refracted ray differ by
/// (n_in/n_out)², since n²·cosθ·dω is invariant; eq. 54 has cosθ_out/cosθ_in there, which is unbiased but not the
/// balance heuristic. cosKnown: geometric, on the side that the sub-path came from; eta: n_out/n_in.
void scatterSpecular(inout Path path, real cosKnown, bool transmitted, real eta) {
    path.dVCM = 0.0;
    path.dVC *= cosKnown;
    if (lobe(LOBE_DIELECTRIC) && transmitted) path.dVC /= eta * eta;
}

/// Leaving a vertex by a density (eq. 34–36). cosNew: geometric, of the direction taken.
void scatterNonSpecular(inout Path path, real endDensity, real cosNew, real pdf, real reversePdf) {
    path.dVC = cosNew / pdf * furtherTechniques(path, endDensity, reversePdf);
    path.dVCM = 1.0 / pdf;
}

/// Leaving a vertex, by a delta lobe or by a density; the rest as of scatterSpecular and scatterNonSpecular.
void scatterDensities(inout Path path, bool specular, real endDensity, real cosKnown, real cosNew, real pdf,
                      real reversePdf, bool transmitted, real eta) {
    if (specular)
        scatterSpecular(path, cosKnown, transmitted, eta);
    else
        scatterNonSpecular(path, endDensity, cosNew, pdf, reversePdf);
}

// ---- Weights ---------------------------------------------------------------------------------------------------

/// Whether a path of this many edges is asked for, with s light and t camera vertices and, for tests, that technique
/// alone.
bool wantedLength(uint edges) { return edges >= job.lengths.x && edges <= job.lengths.y; }
bool wantedTechnique(uint s, uint t) { return !term(TERM_SINGLE) || (s == job.lengths.z && t == job.lengths.w); }

/// The balance heuristic's weight from the ratios of all other techniques to this one; 1 for a technique alone.
real misWeight(real lightRatio, real cameraRatio) {
    return term(TERM_SINGLE) ? 1.0 : 1.0 / (1.0 + lightRatio + cameraRatio);
}

/// A camera path that met an emitter (eq. 42, 43). pdfNextEvent, pdfEmit: P_dir and P_emit, in the measure of the
/// path's own densities.
real weightEmitterHit(Path path, real pdfNextEvent, real pdfEmit) {
    if (term(TERM_FIRST_DIFFUSE)) return (path.flags & PATH_SPECULAR) != 0u ? 1.0 : 0.0;
    return pathLength(path) == 1u ? 1.0
                                  : misWeight(0.0, push.nextEventCount * pdfNextEvent * path.dVCM + pdfEmit * path.dVC);
}

/// A camera vertex and a sampled light point (eq. 44, 45). pdfLight: q·p per solid angle at the vertex; emitRatio:
/// P_emit/(q·p·cosine at the light); pdf: of meeting the light from the vertex, per solid angle; reversePdf: of the
/// other way through the vertex. cosGeometric: of the vertex, in a medium times the density of the flight to it.
real weightNextEvent(Path path, bool delta, real pdfLight, real emitRatio, real cosGeometric, real pdf,
                     real reversePdf) {
    real hitRatio = delta ? 0.0 : push.hitCount * pdf / pdfLight;
    return misWeight(hitRatio, emitRatio * cosGeometric * furtherTechniques(path, cameraEndDensity(path), reversePdf));
}

/// A camera vertex x and a light vertex y at the square of a distance from it (eq. 40, 41). endDensityY: times its
/// count. cosX, cosY: in a medium times the density of the flight to the vertex.
real weightConnection(Path x, real pdfX, real reverseX, real cosX, Path y, real endDensityY, real pdfY, real reverseY,
                      real cosY, real distance2) {
    real lightRatio = pdfX * cosY / distance2 * furtherTechniques(y, endDensityY, reverseY);
    real cameraRatio = pdfY * cosX / distance2 * furtherTechniques(x, cameraEndDensity(x), reverseX);
    return misWeight(lightRatio / push.connectCount, cameraRatio / push.connectCount);
}

/// A light vertex that a camera ray would meet with `pdfArea`, in a medium per volume (eq. 46, 47).
real weightSplat(Path path, real pdfArea, real reversePdf) {
    return misWeight(pdfArea / push.lightPathCount * furtherTechniques(path, lightEndDensity(path), reversePdf), 0.0);
}

/// A camera vertex and a light vertex in its reach (eq. 38, 39). pdf, reversePdf: of the camera vertex's BSDF towards
/// where the light vertex came from, and back.
real weightMerge(real endDensityCamera, real dVCCamera, real endDensityLight, real dVCLight, real pdf,
                 real reversePdf) {
    if (term(TERM_FIRST_DIFFUSE)) return 1.0;
    return misWeight((endDensityLight + dVCLight * pdf) * push.inverseMergeCount,
                     (endDensityCamera + dVCCamera * reversePdf) * push.inverseMergeCount);
}
#endif
