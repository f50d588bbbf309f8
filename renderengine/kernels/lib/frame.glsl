// Orthonormal frames, warps of the unit square, and directions as two numbers.
#ifndef ANTIPODE_FRAME
#define ANTIPODE_FRAME
#include "lib/transcendental.glsl"

/// Tangents t and b with (t, b, n) right-handed and orthonormal, for unit n.
/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
void tangentFrame(real3 n, out real3 t, out real3 b) {
    real s = n.z >= 0.0 ? 1.0 : -1.0;
    real a = -1.0 / (s + n.z);
    real c = n.x * n.y * a;
    t = real3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    b = real3(c, s + n.y * n.y * a, -n.y);
}

real3 toWorld(real3 local, real3 n) {
    real3 t, b;
    tangentFrame(n, t, b);
    return t * local.x + b * local.y + n * local.z;
}

/// Uniform on the unit disk, by angle and radius.
real2 sampleDisk(real2 u) {
    real r = sqrt(u.x), phi = 2.0 * PI * (u.y - 0.5);
    return r * real2(cos(phi), sin(phi));
}

/// Cosine-weighted on the hemisphere about +z; pdfSolidAngle = z/π.
real3 sampleCosineHemisphere(real2 u) {
    real2 d = sampleDisk(u);
    return real3(d, sqrt(max(1.0 - u.x, 0.0)));
}

/// Uniform on the unit sphere; pdfSolidAngle = 1/(4π).
real3 sampleSphere(real2 u) {
    real z = 1.0 - 2.0 * u.x, phi = 2.0 * PI * (u.y - 0.5);
    real r = 2.0 * sqrt(u.x * (1.0 - u.x));
    return real3(r * cos(phi), r * sin(phi), z);
}

/// Octahedral map of a unit direction (Cigolle et al., JCGT 3(2), 2014). Comes back within 4 roundings; axes exactly.
real2 packDirection(real3 d) {
    real2 o = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
    return d.z < 0.0 ? (1.0 - abs(o.yx)) * real2(o.x >= 0.0 ? 1.0 : -1.0, o.y >= 0.0 ? 1.0 : -1.0) : o;
}

real3 unpackDirection(real2 o) {
    real3 d = real3(o, 1.0 - abs(o.x) - abs(o.y));
    real t = max(-d.z, 0.0);
    d.x += d.x >= 0.0 ? -t : t;
    d.y += d.y >= 0.0 ? -t : t;
    return normalize(d);
}
#endif
