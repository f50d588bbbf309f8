// Emitters: choosing one by power, the start of light paths, next-event samples, and what a hit emitter would have
// cost. Densities follow the table in Georgiev 2012: P = q·p, with q the probability of picking the light.
#ifndef ANTIPODE_LIGHT
#define ANTIPODE_LIGHT
#include "lib/frame.glsl"
#include "lib/surface.glsl"

layout(set = 0, binding = BIND_LIGHTS) uniform usamplerBuffer lights;
layout(set = 0, binding = BIND_ENVIRONMENT_MAP) uniform samplerBuffer environmentMap;
layout(set = 0, binding = BIND_ENVIRONMENT_ALIAS) uniform usamplerBuffer environmentAlias;

struct Emission {  // the start of a light path
    real3 origin, direction;
    real3 throughput;  // emitted·cosine / P_emit
    real dVCM, dVC;    // P_dir/P_emit, cosine/P_emit (0 for delta lights): without sample counts
    uint primitive;
    bool infinite, valid;
};

struct DirectLight {  // a next-event sample
    real3 target, direction;
    real3 value;     // radiance or intensity over (q·pdf), distance included
    real pdf;        // q·p in solid angle at the receiver
    real emitRatio;  // P_emit/(q·p·cosine at the light)
    uint primitive;
    bool delta, valid;
};

/// Index and fraction of a draw from an alias table of `count` entries, from two numbers in [0,1): 32 random bits,
/// since 24 would leave the fraction too few for tables of many entries.
uint aliasSlot(real2 u, uint count, out real fraction) {
    uint bits = (uint(u.x * 16777216.0) << 8) | uint(u.y * 256.0);
    uint index, low;
    umulExtended(bits, count, index, low);
    fraction = real(low >> 8) * 5.9604644775390625e-8;
    return index;
}

/// A light by power; q is its probability.
uint pickLight(real2 u, out real q) {
    real fraction;
    uint index = aliasSlot(u, job.image.z, fraction);
    uvec4 l1 = texelFetch(lights, int(index * LIGHT_TEXELS + 1u));
    uvec4 l2 = texelFetch(lights, int(index * LIGHT_TEXELS + 2u));
    if (fraction >= uintBitsToFloat(l1.w)) index = l2.w;
    q = uintBitsToFloat(texelFetch(lights, int(index * LIGHT_TEXELS)).w);
    return index;
}

/// Radiance that a material emits at uv.
real3 emittedRadiance(uint material, real2 uv) {
    real3 e = uintBitsToFloat(texelFetch(materials, int(material * MATERIAL_TEXELS + 2u)).xyz);
    if (feature(FEATURE_TEXTURES)) {
        uint map = texelFetch(materials, int(material * MATERIAL_TEXELS + 4u)).y;
        if (map != NO_INDEX) e *= sampleTexture(map, uv).rgb;
    }
    return e;
}
bool emitsBothSides(uint material) {
    return (texelFetch(materials, int(material * MATERIAL_TEXELS)).w & MATERIAL_EMITS_BOTH_SIDES) != 0u;
}

/// Surface area of an emitting primitive.
real emitterArea(uint primitive) {
    uvec4 r0 = texelFetch(primitives, int(3u * primitive)), r1 = texelFetch(primitives, int(3u * primitive + 1u)),
          r2 = texelFetch(primitives, int(3u * primitive + 2u));
    if (feature(FEATURE_LIGHT_SPHERES) && r2.w == PRIMITIVE_SPHERE) {
        real radius = uintBitsToFloat(r1.x);
        return 4.0 * PI * radius * radius;
    }
    real3 p0 = uintBitsToFloat(r0.xyz);
    return 0.5 * length(cross(uintBitsToFloat(r1.xyz) - p0, uintBitsToFloat(r2.xyz) - p0));
}

/// A uniformly distributed point of an emitting primitive.
Surface sampleEmitter(uint primitive, real2 u) {
    real r = sqrt(u.x);
    real3 towards = real3(0.0);
    if (feature(FEATURE_LIGHT_SPHERES)) {
        uvec4 r0 = texelFetch(primitives, int(3u * primitive));
        real radius = uintBitsToFloat(texelFetch(primitives, int(3u * primitive + 1u)).x);
        towards = uintBitsToFloat(r0.xyz) + sampleSphere(u) * radius;
    }
    return surfaceAt(primitive, r * (1.0 - u.y), r * u.y, towards);
}

// ---- Environment -----------------------------------------------------------------------------------------------
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

/// Versines, 1 − cosine, of the angle to the axis and of the half-angles. Clamped, it is the falloff's definition.
real spotFalloff(real versine, real versineInner, real versineOuter) {
    real t = versineInner < versineOuter ? clamp((versineOuter - versine) / (versineOuter - versineInner), 0.0, 1.0)
                                         : (versine <= versineOuter ? 1.0 : 0.0);
    return t * t;
}

// ---- The start of a light path ---------------------------------------------------------------------------------
Emission sampleEmission(real4 u, real4 v) {
    Emission e;
    e.valid = false;
    e.infinite = false;
    e.primitive = NO_INDEX;
    e.origin = e.direction = e.throughput = real3(0.0);
    e.dVCM = e.dVC = 0.0;
    real q;
    uint light = pickLight(u.xy, q);
    uvec4 l0 = texelFetch(lights, int(light * LIGHT_TEXELS)), l1 = texelFetch(lights, int(light * LIGHT_TEXELS + 1u)),
          l2 = texelFetch(lights, int(light * LIGHT_TEXELS + 2u)),
          l3 = texelFetch(lights, int(light * LIGHT_TEXELS + 3u));
    if (feature(FEATURE_LIGHT_TRIANGLES | FEATURE_LIGHT_SPHERES) && (l0.x == LIGHT_TRIANGLE || l0.x == LIGHT_SPHERE)) {
        Surface s = sampleEmitter(l0.y, u.zw);
        real3 local = sampleCosineHemisphere(v.xy);
        bool both = emitsBothSides(l0.z);
        real3 n = both && v.z < 0.5 ? -s.normal : s.normal;
        real pdfArea = 1.0 / emitterArea(l0.y);
        real pdfDirection = local.z / PI * (both ? 0.5 : 1.0);
        real pdf = q * pdfArea * pdfDirection;
        e.direction = toWorld(local, n);
        e.origin = leaveSurface(s, e.direction);
        e.primitive = l0.y;
        e.valid = local.z > 0.0;
        e.throughput = emittedRadiance(l0.z, s.uv) * (local.z / pdf);
        e.dVCM = q * pdfArea / pdf;
        e.dVC = local.z / pdf;
    }
    if (feature(FEATURE_LIGHT_POINTS | FEATURE_LIGHT_SPOTS) && (l0.x == LIGHT_POINT || l0.x == LIGHT_SPOT)) {
        e.origin = uintBitsToFloat(l1.xyz);
        real pdf = q * 0.25 / PI;
        e.direction = sampleSphere(u.zw);
        real3 intensity = uintBitsToFloat(l2.xyz);
        if (feature(FEATURE_LIGHT_SPOTS) && l0.x == LIGHT_SPOT) {
            real3 axis = uintBitsToFloat(l3.xyz);
            real versineOuter = uintBitsToFloat(l3.w), versineInner = uintBitsToFloat(l0.y);
            real versine = versineOuter * u.z;
            real sn = sqrt(max(versine * (2.0 - versine), 0.0)), phi = 2.0 * PI * (u.w - 0.5);
            e.direction = toWorld(real3(sn * cos(phi), sn * sin(phi), 1.0 - versine), axis);
            pdf = q / (2.0 * PI * versineOuter);
            intensity *= spotFalloff(versine, versineInner, versineOuter);
        }
        e.throughput = intensity / pdf;
        e.dVCM = q / pdf;
        e.valid = true;
    }
    if (feature(FEATURE_LIGHT_DIRECTIONALS | FEATURE_ENVIRONMENT) &&
        (l0.x == LIGHT_DIRECTIONAL || l0.x == LIGHT_ENVIRONMENT)) {
        real radius = job.sceneCenter.w;
        real pdfDisk = 1.0 / (PI * radius * radius);
        real pdfDirection = 1.0;
        real3 value = uintBitsToFloat(l2.xyz);
        e.direction = uintBitsToFloat(l1.xyz);
        if (feature(FEATURE_ENVIRONMENT) && l0.x == LIGHT_ENVIRONMENT) {
            e.direction = -sampleEnvironment(u.zw, v.zw, value, pdfDirection);
        }
        real pdf = q * pdfDirection * pdfDisk;
        real2 d = sampleDisk(v.xy);
        real3 t, b;
        tangentFrame(e.direction, t, b);
        e.origin = job.sceneCenter.xyz + radius * (d.x * t + d.y * b - e.direction);
        e.throughput = value / pdf;
        e.dVCM = q * pdfDirection / pdf;
        e.dVC = l0.x == LIGHT_ENVIRONMENT ? 1.0 / pdf : 0.0;
        e.infinite = true;
        e.valid = pdfDirection > 0.0;
    }
    return e;
}

// ---- Next event ------------------------------------------------------------------------------------------------
/// `more` is used by environment maps alone.
DirectLight sampleDirect(real3 position, real4 u, real2 more) {
    DirectLight r;
    r.valid = false;
    r.delta = false;
    r.primitive = NO_INDEX;
    r.target = position;
    r.direction = r.value = real3(0.0);
    r.pdf = r.emitRatio = 1.0;
    real q;
    uint light = pickLight(u.xy, q);
    uvec4 l0 = texelFetch(lights, int(light * LIGHT_TEXELS)), l1 = texelFetch(lights, int(light * LIGHT_TEXELS + 1u)),
          l2 = texelFetch(lights, int(light * LIGHT_TEXELS + 2u)),
          l3 = texelFetch(lights, int(light * LIGHT_TEXELS + 3u));
    if (feature(FEATURE_LIGHT_TRIANGLES | FEATURE_LIGHT_SPHERES) && (l0.x == LIGHT_TRIANGLE || l0.x == LIGHT_SPHERE)) {
        Surface s = sampleEmitter(l0.y, u.zw);
        real3 d = s.position - position;
        real d2 = dot(d, d);
        r.direction = d * inversesqrt(d2);
        real c = -dot(r.direction, s.normal);
        bool both = emitsBothSides(l0.z);
        if (both) c = abs(c);
        real area = emitterArea(l0.y);
        r.pdf = q * d2 / (c * area);
        r.emitRatio = (both ? 0.5 : 1.0) * c / (PI * d2);
        r.value = emittedRadiance(l0.z, s.uv) / r.pdf;
        r.target = leaveSurface(s, -r.direction);
        r.primitive = l0.y;
        r.valid = c > 0.0 && d2 > 0.0;
    }
    if (feature(FEATURE_LIGHT_POINTS | FEATURE_LIGHT_SPOTS) && (l0.x == LIGHT_POINT || l0.x == LIGHT_SPOT)) {
        r.target = uintBitsToFloat(l1.xyz);
        real3 d = r.target - position;
        real d2 = dot(d, d);
        r.direction = d * inversesqrt(d2);
        real3 intensity = uintBitsToFloat(l2.xyz);
        real pdfEmit = 0.25 / PI;
        if (feature(FEATURE_LIGHT_SPOTS) && l0.x == LIGHT_SPOT) {
            real versineOuter = uintBitsToFloat(l3.w), versineInner = uintBitsToFloat(l0.y);
            real3 offAxis = r.direction + uintBitsToFloat(l3.xyz);
            intensity *= spotFalloff(0.5 * dot(offAxis, offAxis), versineInner, versineOuter);
            pdfEmit = 1.0 / (2.0 * PI * versineOuter);
        }
        r.pdf = q * d2;
        r.emitRatio = pdfEmit / d2;
        r.value = intensity / r.pdf;
        r.delta = true;
        r.valid = d2 > 0.0;
    }
    if (feature(FEATURE_LIGHT_DIRECTIONALS | FEATURE_ENVIRONMENT) &&
        (l0.x == LIGHT_DIRECTIONAL || l0.x == LIGHT_ENVIRONMENT)) {
        real radius = job.sceneCenter.w;
        real pdfDirection = 1.0;
        real3 value = uintBitsToFloat(l2.xyz);
        r.direction = -uintBitsToFloat(l1.xyz);
        r.delta = true;
        if (feature(FEATURE_ENVIRONMENT) && l0.x == LIGHT_ENVIRONMENT) {
            r.direction = sampleEnvironment(u.zw, more, value, pdfDirection);
            r.delta = false;
        }
        r.pdf = q * pdfDirection;
        r.emitRatio = 1.0 / (PI * radius * radius);
        r.value = value / r.pdf;
        // Beyond everything: twice the bounding sphere's diameter.
        r.target = position + r.direction * (4.0 * radius);
        r.valid = pdfDirection > 0.0;
    }
    return r;
}
#endif
