// Orthonormal frames, warps of the unit square, and directions in 24 + 24 bits.
#ifndef ANTIPODE_FRAME
#define ANTIPODE_FRAME

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

/// Octahedral map of a unit direction (Cigolle et al., JCGT 3(2), 2014), 24 bits a coordinate, beside a 16-bit number.
/// Comes back within 6e-7; axes exactly, for which zero must be one of the signed steps.
uvec2 packDirection(real3 d, uint number) {
    real2 o = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
    if (d.z < 0.0) o = (1.0 - abs(o.yx)) * real2(o.x >= 0.0 ? 1.0 : -1.0, o.y >= 0.0 ? 1.0 : -1.0);
    uvec2 q = uvec2(ivec2(round(o * 8388607.0)) + 8388608);
    return (q << 8) | uvec2(number & 0xFFu, (number >> 8) & 0xFFu);
}

real3 unpackDirection(uvec2 bits) {
    real2 o = real2(ivec2(bits >> 8) - 8388608) / 8388607.0;
    real3 d = real3(o, 1.0 - abs(o.x) - abs(o.y));
    real t = max(-d.z, 0.0);
    d.x += d.x >= 0.0 ? -t : t;
    d.y += d.y >= 0.0 ? -t : t;
    return normalize(d);
}

uint unpackNumber(uvec2 bits) { return (bits.x & 0xFFu) | ((bits.y & 0xFFu) << 8); }
#endif
