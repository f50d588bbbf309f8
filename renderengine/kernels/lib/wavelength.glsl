// The one wavelength that all paths of an iteration have, where glass disperses light (FEATURE_DISPERSION). Whatever
// met no such glass is the same at every wavelength, and is taken for all of them at once.
#ifndef ANTIPODE_WAVELENGTH
#define ANTIPODE_WAVELENGTH
#include "lib/real.glsl"

// xyz: what the three channels see of it over the density that it was drawn with, of mean 1 each; w: how far the index
// of refraction is from n_d there, in units of n_F − n_C (techniques/wavelength.h).
layout(set = 0, binding = BIND_WAVELENGTH, std430) readonly buffer Wavelength { real4 wavelength; };

/// The index of refraction, of n_d = `ior` and n_F − n_C = `spread`.
real indexAtWavelength(real ior, real spread) { return ior + spread * wavelength.w; }

/// What the channels see of what a whole path carries; `dispersed`: one of its vertices depends on the wavelength.
/// Called once for each, when nothing follows but the sum.
real3 seenAtWavelength(real3 value, bool dispersed) {
    return feature(FEATURE_DISPERSION) && dispersed ? value * wavelength.xyz : value;
}
#endif
