// What all lobes share: the material at a surface, a sampled direction, and the sum of the lobes there. Each file
// beside this one holds one kind: how it is sampled, its value, and its densities both ways.
#ifndef ANTIPODE_LOBE
#define ANTIPODE_LOBE
#include "lib/frame.glsl"
#include "lib/microfacet.glsl"
#include "lib/surface.glsl"
#include "lib/transcendental.glsl"

struct Bsdf {
    uint kind;
    bool specular;  // delta lobes only: nothing to evaluate, connect or merge
    bool black;     // reflects nothing on this side
    real3 diffuse;  // Lambertian albedo
    real3 glossy;   // Phong, mirror: reflectance; metallic-roughness: F0
    real f90;       // metallic-roughness
    real exponent;  // Phong
    real alpha;     // GGX
    real eta;       // dielectrics: index beyond over index on the side of wKnown
    real3 conductorEta, conductorK;
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

bool hasKind(Bsdf b, uint featureBit, uint kind) { return feature(featureBit) && b.kind == kind; }

/// The unit direction that `wKnown` is refracted to at a normal `h` on its side, with cosine `cosKnown` > 0 between
/// them; eta: index beyond over index here. Where refraction is possible.
real3 refractAbout(real3 wKnown, real3 h, real cosKnown, real eta) {
    real cosT = sqrt(max(1.0 - (1.0 - cosKnown * cosKnown) / (eta * eta), 0.0));
    return normalize(-wKnown / eta + h * (cosKnown / eta - cosT));
}
#endif
