// The environment: constant, or a map whose texels are drawn by power and solid angle.
#ifndef ANTIPODE_ENVIRONMENT_LIGHT
#define ANTIPODE_ENVIRONMENT_LIGHT
#include "lib/lights/distant.glsl"

layout(set = 0, binding = BIND_ENVIRONMENT_MAP) uniform samplerBuffer environmentMap;
layout(set = 0, binding = BIND_ENVIRONMENT_ALIAS) uniform usamplerBuffer environmentAlias;

real2 environmentUv(real3 d) {
    if (job.environmentSize.z != 0u) d = real3(d.x, d.z, -d.y);
    real u = atan(d.x, -d.z) / (2.0 * PI) + 0.5 - job.gridOrigin.w;
    real v = atan(length(d.xz), d.y) / PI;
    return real2(u - floor(u), clamp(v, 0.0, 1.0));
}

/// Radiance from `direction`, of a ray that met nothing, and the density with which sampleEnvironment draws it.
real3 evalEnvironment(real3 direction, out real pdfSolidAngle) {
    pdfSolidAngle = 0.25 / PI;
    real3 value = job.environment.xyz;
    if (feature(FEATURE_ENVIRONMENT_MAP)) {
        real2 uv = environmentUv(direction);
        ivec2 size = ivec2(job.environmentSize.xy);
        ivec2 texel = min(ivec2(uv * real2(size)), size - 1);
        real4 e = texelFetch(environmentMap, texel.y * size.x + texel.x);
        value *= e.rgb;
        pdfSolidAngle = e.w;
    }
    return value;
}

/// A direction towards the environment: a texel by power, then uniform in solid angle within it. `pick` chooses the
/// texel, or the direction where the environment is constant. Radiance and density are the texel's own: looked up by
/// the rounded direction they could be a neighbour's, which may be black.
real3 sampleEnvironment(real2 pick, real2 inside, out real3 radiance_, out real pdfSolidAngle) {
    radiance_ = job.environment.xyz;
    pdfSolidAngle = 0.25 / PI;
    if (!feature(FEATURE_ENVIRONMENT_MAP)) return sampleSphere(pick);
    uvec2 size = job.environmentSize.xy;
    real fraction;
    uint index = aliasSlot(pick, size.x * size.y, fraction);
    uvec4 alias = texelFetch(environmentAlias, int(index));
    if (fraction >= uintBitsToFloat(alias.x)) index = alias.y;
    real4 e = texelFetch(environmentMap, int(index));
    radiance_ *= e.rgb;
    pdfSolidAngle = e.w;
    uint row = index / size.x;
    // Uniform in the haversine of the angle to the nearer pole: the cosine of a map's last rows would round to 1.
    bool south = 2u * row >= size.y;
    real s0 = sin(0.5 * PI * real(south ? size.y - row : row) / real(size.y));
    real s1 = sin(0.5 * PI * real(south ? size.y - row - 1u : row + 1u) / real(size.y));
    real h = mix(s0 * s0, s1 * s1, inside.y);
    real c = south ? 2.0 * h - 1.0 : 1.0 - 2.0 * h, s = 2.0 * sqrt(h * (1.0 - h));
    real uAt = (real(index % size.x) + inside.x) / real(size.x) + job.gridOrigin.w;
    real phi = 2.0 * PI * (uAt - 0.5);
    real3 d = real3(s * sin(phi), c, -s * cos(phi));
    return job.environmentSize.z != 0u ? real3(d.x, -d.z, d.y) : d;
}

DistantLight sampleEnvironmentLight(real2 pick, real2 inside) {
    DistantLight distant;
    distant.direction = sampleEnvironment(pick, inside, distant.value, distant.pdf);
    distant.delta = false;
    return distant;
}

/// Of a ray that met nothing.
EmitterHit hitEnvironment(real3 direction) {
    real pdf;
    real3 value = evalEnvironment(direction, pdf);
    real radius = job.sceneCenter.w, q = job.environment.w;
    return EmitterHit(value, q * pdf, q * pdf / (PI * radius * radius), true);
}
#endif
