// The GGX distribution of microfacet normals (Walter et al. 2007), isotropic, in the local frame with +z the normal.
#ifndef ANTIPODE_MICROFACET
#define ANTIPODE_MICROFACET
#include "lib/frame.glsl"

/// Density of the normals' projected area, D(h), of unit h about unit n; 0 below the horizon.
real ggxDistribution(real3 h, real3 n, real alpha) {
    // Both 1 + (α²−1)cos² and a sin² = 1 − cos² lose the small sine where α is below 10⁻²; the cross product keeps it.
    real3 s = cross(h, n);
    real c = dot(h, n);
    real root = alpha / (dot(s, s) + alpha * alpha * (c * c));  // squared last: α⁴ would underflow
    return c > 0.0 ? root * root / PI : 0.0;
}

/// Smith's Λ for |cosθ|.
real ggxLambda(real cosTheta, real alpha) {
    real c2 = cosTheta * cosTheta;
    real tan2 = max(1.0 - c2, 0.0) / c2;
    return 0.5 * (sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

real ggxG1(real cosTheta, real alpha) { return 1.0 / (1.0 + ggxLambda(abs(cosTheta), alpha)); }
/// Height-correlated masking and shadowing (Heitz 2014, eq. 99).
real ggxG2(real cosThetaO, real cosThetaI, real alpha) {
    return 1.0 / (1.0 + ggxLambda(abs(cosThetaO), alpha) + ggxLambda(abs(cosThetaI), alpha));
}

/// A visible normal for w with w.z > 0: density G1(w)·max(w·h,0)·D(h)/w.z. Heitz, JCGT 7(4), 2018.
real3 ggxSampleVisibleNormal(real3 w, real alpha, real2 u) {
    real3 v = normalize(real3(alpha * w.xy, w.z));
    real l2 = dot(v.xy, v.xy);
    real3 t1 = l2 > 0.0 ? real3(-v.y, v.x, 0.0) * inversesqrt(l2) : real3(1.0, 0.0, 0.0);
    real3 t2 = cross(v, t1);
    real2 p = sampleDisk(u);
    real s = 0.5 * (1.0 + v.z);
    p.y = (1.0 - s) * sqrt(max(1.0 - p.x * p.x, 0.0)) + s * p.y;
    real3 n = p.x * t1 + p.y * t2 + sqrt(max(1.0 - dot(p, p), 0.0)) * v;
    return normalize(real3(alpha * n.xy, max(n.z, 0.0)));
}

/// Reflection at GGX microfacets from one direction into another on the same side: what the lobes that have them share,
/// so that it is computed once whichever of them the material has.
struct Microfacets {
    real cosKnown, cosNew;        // to the normal, both positive
    real cosHalf;                 // of either direction to the microfacet's normal
    real distribution;            // D(h)
    real maskedKnown, maskedNew;  // G1
    real value;                   // the BSDF where all is reflected
};

/// cosKnown, cosNew: of the directions to n; given, so that whoever asks of their signs asks of the same numbers.
Microfacets reflectingMicrofacets(real3 wKnown, real3 wNew, real cosKnown, real cosNew, real3 n, real alpha) {
    Microfacets m;
    m.cosKnown = cosKnown;
    m.cosNew = cosNew;
    real3 h = normalize(wKnown + wNew);
    m.cosHalf = dot(wKnown, h);
    m.distribution = ggxDistribution(h, n, alpha);
    m.maskedKnown = ggxG1(m.cosKnown, alpha);
    m.maskedNew = ggxG1(m.cosNew, alpha);
    m.value = m.distribution * ggxG2(m.cosKnown, m.cosNew, alpha) / (4.0 * m.cosKnown * m.cosNew);
    return m;
}

/// Densities of reflecting about a visible normal, where the lobe that does is chosen with this chance.
real microfacetPdf(Microfacets m, real chance) { return chance * m.maskedKnown * m.distribution / (4.0 * m.cosKnown); }
real microfacetReversePdf(Microfacets m, real chance) {
    return chance * m.maskedNew * m.distribution / (4.0 * m.cosNew);
}

/// The same in world space, about the normal n.
real3 sampleVisibleNormal(real3 w, real3 n, real alpha, real2 u) {
    real3 t, b;
    tangentFrame(n, t, b);
    real3 h = ggxSampleVisibleNormal(real3(dot(w, t), dot(w, b), dot(w, n)), alpha, u);
    return t * h.x + b * h.y + n * h.z;
}

/// Unpolarised Fresnel reflectance of a smooth interface; eta = index beyond over index on the side of cosThetaI ≥ 0.
real fresnelDielectric(real cosThetaI, real eta) {
    real sin2T = max(1.0 - cosThetaI * cosThetaI, 0.0) / (eta * eta);
    if (sin2T >= 1.0) return 1.0;
    real cosThetaT = sqrt(1.0 - sin2T);
    real parallel = (eta * cosThetaI - cosThetaT) / (eta * cosThetaI + cosThetaT);
    real perpendicular = (cosThetaI - eta * cosThetaT) / (cosThetaI + eta * cosThetaT);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

/// Unpolarised Fresnel reflectance of a conductor of complex index eta + i·k against vacuum (Born & Wolf, 14.2).
real3 fresnelConductor(real cosThetaI, real3 eta, real3 k) {
    real c2 = cosThetaI * cosThetaI, s2 = 1.0 - c2;
    real3 t0 = eta * eta - k * k - s2;
    real3 a2b2 = sqrt(t0 * t0 + 4.0 * eta * eta * k * k);
    real3 t1 = a2b2 + c2;
    real3 a = sqrt(max(0.5 * (a2b2 + t0), real3(0.0)));
    real3 t2 = 2.0 * cosThetaI * a;
    real3 rs = (t1 - t2) / (t1 + t2);
    real3 t3 = c2 * a2b2 + s2 * s2, t4 = t2 * s2;
    return 0.5 * (rs + rs * (t3 - t4) / (t3 + t4));
}

real3 fresnelSchlick(real cosTheta, real3 f0, real f90) {
    real m = 1.0 - cosTheta, m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}
#endif
