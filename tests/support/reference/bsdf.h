// The reference BSDFs, one per MaterialKind (no textures, no glass in MetallicRoughness).
// Directions are local and unit: z is the front normal, wo leads to the viewer, wi to the light, both leave the
// surface. A thin dielectric is a pane. f is the radiance BSDF of camera paths: refraction scales by (index at wo /
// index at wi)². A material whose `twoSided` is false neither reflects nor emits at its back; dielectric kinds ignore
// that.
#pragma once

#include <optional>

#include "renderengine/scene.h"
#include "support/random.h"

namespace antipode::reference {

/// Throws Error(Usage) where the reference cannot render the material.
void requireSupported(const Material& material);

/// True for materials all of whose scattering is a delta distribution (Mirror, Dielectric).
bool isSpecular(const Material& material);

/// An upper bound of the directional albedo from the material's constants alone, in [0, 1].
double albedoBound(const Material& material);

/// Russian roulette survival min(albedoBound, 0.98): a function of the material only.
double rouletteSurvival(const Material& material);

struct BsdfSample {
    Vec3d wi;
    Vec3d weight;    ///< f·|cosθi|/pdf; for specular materials the delta's weight
    double pdf = 0;  ///< per solid angle; for specular materials the discrete probability of the branch
    bool specular = false;
};

/// Empty where no direction is sampled: light is absorbed (also a sample below the surface).
std::optional<BsdfSample> sampleBsdf(const Material& material, const Vec3d& wo, Random& random);
/// f(wo, wi), 1/sr; 0 for specular materials.
Vec3d evalBsdf(const Material& material, const Vec3d& wo, const Vec3d& wi);
/// Density of wi per solid angle given wo, as sampled by sampleBsdf; 0 for specular materials.
double pdfBsdf(const Material& material, const Vec3d& wo, const Vec3d& wi);
/// Discrete probability of the specular branch that leads from wo to wi's side of the surface.
double specularProbability(const Material& material, const Vec3d& wo, const Vec3d& wi);

/// The refracted direction of wo at a smooth interface of index `ior` (behind over front); empty on total reflection.
std::optional<Vec3d> refract(const Vec3d& wo, double ior);

}  // namespace antipode::reference
