// Multiple importance sampling over all techniques, balance heuristic, every technique weighted by its sample count:
// emitter hit and next event by 0 or 1, splat by N or 0, connections by κ, merges by η = πr²N.
// dVCM is kept without a count; where it stands for a technique, `endCount` supplies the count: next event or splat
// next to a sub-path's end, connection further on. Equations: Georgiev 2012.
#ifndef ANTIPODE_MIS
#define ANTIPODE_MIS
#include "lib/bsdf.glsl"
#include "lib/state.glsl"

/// Count of the technique that joins this vertex (the sub-path's `length`-th) to the one before it.
real lightEndCount(uint length_) { return length_ == 1u ? push.nextEventCount : push.connectCount; }
real cameraEndCount(uint length_) { return length_ == 1u ? push.splatCount : push.connectCount; }

/// Densities of the last segment become area densities at the vertex that it reaches.
void arrive(inout Path path, real distance_, real cosGeometric) {
    if ((path.flags & PATH_FROM_INFINITY) == 0u) path.dVCM *= distance_ * distance_;
    path.flags &= ~PATH_FROM_INFINITY;
    real inverse = 1.0 / cosGeometric;
    path.dVCM *= inverse;
    path.dVC *= inverse;
}

/// The recursion at a scattering vertex (eq. 34–36, 53–55). `endCount`: of the vertex where it happens.
/// Specular vertices: the densities of the two ways along a refracted ray differ by (n_in/n_out)², since
/// n²·cosθ·dω is invariant; eq. 54 has cosθ_out/cosθ_in there, which is unbiased but not the balance heuristic.
void scatterMis(inout Path path, Bsdf b, BsdfSample s, real3 wKnown, real endCount) {
    if (s.specular) {
        path.dVCM = 0.0;
        path.dVC *= abs(dot(wKnown, b.ng));
        if (feature(FEATURE_DIELECTRIC) && dot(s.direction, b.ng) < 0.0) path.dVC /= b.eta * b.eta;
        return;
    }
    path.dVC = abs(dot(s.direction, b.ng)) / s.pdf * (push.mergeCount + endCount * path.dVCM + s.reversePdf * path.dVC);
    path.dVCM = 1.0 / s.pdf;
}

/// Whether a path of this many edges is asked for, with s light and t camera vertices and, for tests, that technique
/// alone.
bool wantedLength(uint edges) { return edges >= job.lengths.x && edges <= job.lengths.y; }
bool wantedTechnique(uint s, uint t) { return !term(TERM_SINGLE) || (s == job.lengths.z && t == job.lengths.w); }

/// The balance heuristic's weight from the ratios of all other techniques to this one; 1 for a technique alone.
real misWeight(real lightRatio, real cameraRatio) {
    return term(TERM_SINGLE) ? 1.0 : 1.0 / (1.0 + lightRatio + cameraRatio);
}
#endif
