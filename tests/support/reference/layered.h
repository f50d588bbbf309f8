// glTF's metallic-roughness model without glass and textures, with sheen and a clear coat over it. Directions are
// local, wo and wi on the front side.
#pragma once

#include "renderengine/scene.h"
#include "support/random.h"

namespace antipode::reference {

Vec3d evalLayered(const Material& material, const Vec3d& wo, const Vec3d& wi);
/// Density of wi per solid angle given wo, as sampled by sampleLayered.
double pdfLayered(const Material& material, const Vec3d& wo, const Vec3d& wi);
/// May lie below the surface.
Vec3d sampleLayered(const Material& material, const Vec3d& wo, Random& random);

/// White sheen's BRDF: Estevez and Kulla's distribution and masking, height-correlated.
double sheenValue(const Vec3d& wo, const Vec3d& wi, double alpha);
/// A clear coat's.
double coatValue(const Vec3d& wo, const Vec3d& wi, double alpha);

}  // namespace antipode::reference
