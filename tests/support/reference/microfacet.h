// Unpolarised Fresnel reflectance and the isotropic GGX distribution with height-correlated Smith shadowing.
// Directions are local: z is the macroscopic normal, all directions leave the surface.
#pragma once

#include "renderengine/vec.h"

namespace antipode::reference {

/// Fresnel reflectance of a smooth dielectric interface, in [0, 1]; 1 on total reflection.
/// @param cosine      |cosine| of the angle on the incident side
/// @param relativeIor index beyond the interface over index of the incident side
double fresnelDielectric(double cosine, double relativeIor);
/// The s and p polarised parts of the same.
double fresnelDielectricS(double cosine, double relativeIor);
double fresnelDielectricP(double cosine, double relativeIor);

/// Fresnel reflectance of a conductor of relative complex index eta + i·k, in [0, 1].
double fresnelConductor(double cosine, double eta, double k);

/// D(m), per solid angle; ∫ D(m) m_z dm = 1. 0 below the surface. α > 0.
double ggxDistribution(const Vec3d& m, double alpha);
/// Λ(w) of Smith's G1 = 1/(1 + Λ), w_z ≠ 0 (Heitz 2014, eq. 72).
double ggxLambda(const Vec3d& w, double alpha);
/// Height-correlated masking and shadowing for directions on the same side, and the uncorrelated product's analogue
/// 1/(1 + Λo + Λi) used for both reflection and transmission (Heitz 2014, eq. 99).
double ggxShadowing(const Vec3d& wo, const Vec3d& wi, double alpha);

/// A normal visible from wo (wo_z > 0), in the local frame (Heitz 2018).
Vec3d sampleVisibleNormal(const Vec3d& wo, double alpha, double u1, double u2);
/// Density of the normal (not of the reflected direction) per solid angle.
double pdfVisibleNormal(const Vec3d& wo, const Vec3d& m, double alpha);

}  // namespace antipode::reference
