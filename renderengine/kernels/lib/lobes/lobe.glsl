// What all lobes share: the material at a surface, a sampled direction, and the sum of the lobes there. Each file
// beside this one holds one kind: how it is sampled, its value, and its densities both ways.
#ifndef ANTIPODE_LOBE
#define ANTIPODE_LOBE
#include "lib/frame.glsl"
#include "lib/losses.glsl"
#include "lib/microfacet.glsl"
#include "lib/surface.glsl"
#include "lib/transcendental.glsl"

struct Bsdf {
    uint kind;
    bool specular;         // delta lobes only: nothing to evaluate, connect or merge
    bool black;            // reflects nothing on this side
    real3 diffuse;         // Lambertian albedo
    real3 glossy;          // Phong, mirror: reflectance; metallic-roughness: F0
    real f90;              // metallic-roughness
    real baseF0, baseF90;  // of the layer over its diffuse base
    real exponent;         // Phong
    real alpha;            // GGX
    real eta;              // dielectrics: index beyond over index on the side of wKnown
    bool dispersive;       // with FEATURE_DISPERSION: it depends on the wavelength
    real glass;            // share of the surface that is glass, and chance of its lobes, whatever the direction
    bool smoothGlass;      // that part is a delta lobe
    bool thin;             // it is a pane: both faces at once
    real3 tint;            // of what passes it
    real3 conductorEta, conductorK;
    real3 multiple;                   // albedo of what metal scatters more than once, over what is lost of a direction
    real lossKnown, inverseMeanLoss;  // of single scattering: from wKnown, and over the mean of all directions
    real glassLoss;                   // of single scattering at rough glass, from wKnown
    real2 glassMeanLoss;              // of all directions on the side of wKnown, and beyond
    real2 glassPassed;                // of what is lost on either side, the part that leaves on the other one
    real coat, coatRoughness;         // the coat's share, and its perceptual roughness
    real3 sheen;                      // its colour
    real sheenRoughness;
    real diffuseChance;  // of sampling the diffuse lobe, where it does not depend on the direction
    real3 n;             // shading normal on the side of wKnown
    real3 ng;            // geometric normal on the side of wKnown
};

struct BsdfSample {
    real3 direction;
    real3 value;  // BSDF, without the cosine; for delta lobes the coefficient over the chance
    real pdf, reversePdf;
    bool specular;
    bool valid;
    bool zeroPdf;  // drawn on the side that its lobe covers, and yet without density
};

/// The sum of lobes for two directions: BSDF, and densities of sampling either direction from the other.
struct LobeSum {
    real3 value;
    real pdf, reversePdf;
};

real3 reflectAbout(real3 w, real3 n) { return 2.0 * dot(w, n) * n - w; }

bool hasKind(Bsdf b, uint lobeBit, uint kind) { return lobe(lobeBit) && b.kind == kind; }

void scaleLobes(inout LobeSum sum, real factor) {
    sum.value *= factor;
    sum.pdf *= factor;
    sum.reversePdf *= factor;
}

/// Whether light passes without being refracted.
bool isPane(Bsdf b) { return lobe(LOBE_TRANSMISSION) && b.thin; }
/// Index beyond over index on the side of wKnown: radiance that passes is compressed by its square.
real crossedIndex(Bsdf b) { return isPane(b) ? 1.0 : b.eta; }
bool hasSmoothGlass(Bsdf b) {
    return hasKind(b, LOBE_DIELECTRIC, KIND_DIELECTRIC) || (lobe(LOBE_TRANSMISSION) && b.glass > 0.0 && b.smoothGlass);
}
bool hasRoughGlass(Bsdf b) {
    return hasKind(b, LOBE_ROUGH_DIELECTRIC, KIND_ROUGH_DIELECTRIC) ||
           (lobe(LOBE_TRANSMISSION) && b.glass > 0.0 && !b.smoothGlass);
}

/// What a smooth interface reflects at cosine c ≥ 0, or a pane: of R at either face and all that goes to and fro
/// between them, R + (1−R)²R(1 + R² + …) = 2R/(1+R).
real glassReflectance(Bsdf b, real c) {
    real f = fresnelDielectric(c, b.eta);
    return isPane(b) ? 2.0 * f / (1.0 + f) : f;
}

/// The unit direction that `wKnown` is refracted to at a normal `h` on its side, with cosine `cosKnown` > 0 between
/// them; eta: index beyond over index here. Where refraction is possible.
real3 refractAbout(real3 wKnown, real3 h, real cosKnown, real eta) {
    real cosT = sqrt(max(1.0 - (1.0 - cosKnown * cosKnown) / (eta * eta), 0.0));
    return normalize(-wKnown / eta + h * (cosKnown / eta - cosT));
}
#endif
