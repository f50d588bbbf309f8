// Henyey and Greenstein's phase function, "Diffuse Radiation in the Galaxy", Astrophysical Journal 93, 1941:
// p(ω, ω') = (1 − g²)/(4π (1 + g² − 2g cosθ)^(3/2)), θ between the ways that light travels before and after. g is the
// mean cosine: 0 scatters evenly, > 0 on, < 0 back. Per solid angle its own density, and the same both ways.
#ifndef ANTIPODE_PHASE
#define ANTIPODE_PHASE
#include "lib/frame.glsl"

/// Of light that comes from `back` and leaves to `direction`, both unit and leaving the point. By the versine of the
/// angle to the lobe's axis: 1 + g² − 2g cosθ = (1 − |g|)² + 2|g|(1 − cosθ) loses nothing where the lobe is narrow.
real phaseFunction(real3 back, real3 direction, real g) {
    real3 offAxis = g >= 0.0 ? direction + back : direction - back;
    real a = abs(g);
    real squared = (1.0 - a) * (1.0 - a) + a * dot(offAxis, offAxis);
    return (1.0 - a * a) / (4.0 * PI * squared * sqrt(squared));
}

/// A direction with this density. The inverse of its distribution, without the differences that cancel where g is near
/// 0 or ±1: 1 − cosθ = 2(1 − g)²(1 − u)(1 + gu)/(1 − g + 2gu)², and 1 + cosθ with g and u from the other end.
real3 samplePhase(real3 back, real g, real2 u) {
    real v = 1.0 - u.x;
    real scale = 1.0 - g + 2.0 * g * u.x;
    real square = 2.0 / (scale * scale);
    real versine = (1.0 - g) * (1.0 - g) * v * (1.0 + g * u.x) * square;
    real coversine = (1.0 + g) * (1.0 + g) * u.x * (1.0 - g * v) * square;
    real s = sqrt(versine * coversine), phi = 2.0 * PI * (u.y - 0.5);
    return toWorld(real3(s * cos(phi), s * sin(phi), 0.5 * (coversine - versine)), -back);
}
#endif
