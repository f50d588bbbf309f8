// Emitting triangles and spheres: sampled uniformly by area, cosine-distributed.
#ifndef ANTIPODE_AREA_LIGHT
#define ANTIPODE_AREA_LIGHT
#include "lib/alpha.glsl"
#include "lib/lights/light_record.glsl"

const uint FEATURES_AREA_LIGHT = FEATURE_LIGHT_TRIANGLES | FEATURE_LIGHT_SPHERES;

/// Radiance that a material emits.
real3 emittedRadiance(uint material, TexturePoint point) {
    real3 e = uintBitsToFloat(texelFetch(materials, int(material * MATERIAL_TEXELS + 2u)).xyz);
    if (feature(FEATURE_TEXTURES)) {
        uint map = texelFetch(materials, int(material * MATERIAL_TEXELS + 4u)).y;
        if (map != NO_INDEX) e *= sampleTexture(map, point).rgb;
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
    if (feature(FEATURE_LIGHT_SPHERES) && primitiveKind(r2) == PRIMITIVE_SPHERE) {
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

/// Radiance of a point drawn on an emitter: none from a hole, which no ray meets, and less where alpha blends. Points
/// are drawn from holes and from what is left alike.
real3 sampledRadiance(Light light, Surface surface) {
    real3 radiance_ = emittedRadiance(light.material, surface.uv);
    if (feature(FEATURE_ALPHA) && (light.kind == LIGHT_TRIANGLE || blends(light.material)))
        radiance_ *= coverageAt(light.material, surface.uv);
    return radiance_;
}

/// `position`: two random numbers; `direction`: three, the last for the side.
void emitFromArea(inout Emission emission, Light light, real2 position, real3 direction) {
    Surface surface = sampleEmitter(light.primitive, position);
    real3 local = sampleCosineHemisphere(direction.xy);
    bool both = emitsBothSides(light.material);
    real3 n = both && direction.z < 0.5 ? -surface.normal : surface.normal;
    real pdfArea = 1.0 / emitterArea(light.primitive);
    real pdfDirection = local.z / PI * (both ? 0.5 : 1.0);
    real pdf = light.pick * pdfArea * pdfDirection;
    emission.direction = toWorld(local, n);
    emission.origin = leaveSurface(surface, emission.direction);
    emission.primitive = light.primitive;
    emission.valid = local.z > 0.0;
    emission.throughput = sampledRadiance(light, surface) * (local.z / pdf);
    emission.dVCM = light.pick * pdfArea / pdf;
    emission.dVC = local.z / pdf;
}

void sampleArea(inout DirectLight direct, Light light, real3 position, real2 u) {
    Surface surface = sampleEmitter(light.primitive, u);
    real3 d = surface.position - position;
    real d2 = dot(d, d);
    direct.direction = d * inversesqrt(d2);
    real c = -dot(direct.direction, surface.normal);
    bool both = emitsBothSides(light.material);
    if (both) c = abs(c);
    real area = emitterArea(light.primitive);
    direct.pdf = light.pick * d2 / (c * area);
    direct.emitRatio = (both ? 0.5 : 1.0) * c / (PI * d2);
    direct.value = sampledRadiance(light, surface) / direct.pdf;
    direct.target = leaveSurface(surface, -direct.direction);
    direct.primitive = light.primitive;
    direct.valid = c > 0.0 && d2 > 0.0;
}

/// Of a surface that is a light, for a path that arrived from the unit direction `back`.
EmitterHit hitArea(Surface surface, real3 back) {
    real c = dot(back, surface.normal);
    bool both = emitsBothSides(surface.material);
    real pdfArea = pickProbability(surface.light) / emitterArea(surface.primitive);
    real pdfEmit = pdfArea * abs(c) / PI * (both ? 0.5 : 1.0);
    return EmitterHit(emittedRadiance(surface.material, surface.uv), pdfArea, pdfEmit, c > 0.0 || both);
}
#endif
