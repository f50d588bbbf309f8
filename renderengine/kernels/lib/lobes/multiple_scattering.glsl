// Light that rough metal passes from facet to facet before it leaves (Kulla and Conty, "Revisiting Physically Based
// Shading at Imageworks", 2017): a reciprocal lobe (1−E(i))(1−E(o))/(π(1−Ē)), E being the albedo of single scattering,
// which restores what is lost where all is reflected, and by geometric series less where facets absorb. It is drawn as
// a Lambertian one.
#ifndef ANTIPODE_MULTIPLE_SCATTERING
#define ANTIPODE_MULTIPLE_SCATTERING
#include "lib/lobes/lobe.glsl"

/// cosKnown: not above 0 where nothing is scattered. `meanReflectance`: Fresnel's of a facet, weighted by the cosine.
/// `share`: of the surface that is metal.
void loadMultipleScattering(inout Bsdf b, real cosKnown, real3 meanReflectance, real share) {
    b.lossKnown = metalLoss(max(cosKnown, 0.0), b.alpha);
    real lost = metalMeanLoss(b.alpha);
    b.multiple = share * meanReflectance * meanReflectance * (1.0 - lost) / (1.0 - meanReflectance * lost);
    b.inverseMeanLoss = 1.0 / lost;
}

/// The greatest albedo of the lobe for a direction of which single scattering loses this.
real multipleAlbedo(Bsdf b, real loss) { return max(b.multiple.x, max(b.multiple.y, b.multiple.z)) * loss; }

/// Without its densities, which are those of a Lambertian lobe.
void addMultipleScattering(inout LobeSum sum, Bsdf b, real lossNew) {
    sum.value += b.multiple * (b.lossKnown * lossNew * b.inverseMeanLoss / PI);
}
#endif
