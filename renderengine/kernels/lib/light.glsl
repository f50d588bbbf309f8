// Emitters: choosing one by power, and the kinds in lib/lights by what is asked of them.
#ifndef ANTIPODE_LIGHT
#define ANTIPODE_LIGHT
#include "lib/lights/area.glsl"
#include "lib/lights/directional.glsl"
#include "lib/lights/environment.glsl"
#include "lib/lights/point.glsl"
#include "lib/lights/spot.glsl"

/// A light by power; q is its probability.
uint pickLight(real2 u, out real q) {
    real fraction;
    uint index = aliasSlot(u, job.image.z, fraction);
    uvec4 l1 = texelFetch(lights, int(index * LIGHT_TEXELS + 1u));
    uvec4 l2 = texelFetch(lights, int(index * LIGHT_TEXELS + 2u));
    if (fraction >= uintBitsToFloat(l1.w)) index = l2.w;
    q = pickProbability(index);
    return index;
}

bool hasLightKind(Light light, uint featureBit, uint kind) { return feature(featureBit) && light.kind == kind; }
bool isAreaLight(Light light) {
    return feature(FEATURES_AREA_LIGHT) && (light.kind == LIGHT_TRIANGLE || light.kind == LIGHT_SPHERE);
}

bool isDistantLight(Light light) {
    return feature(FEATURE_LIGHT_DIRECTIONALS | FEATURE_ENVIRONMENT) &&
           (light.kind == LIGHT_DIRECTIONAL || light.kind == LIGHT_ENVIRONMENT);
}

/// A direction to a light at infinity; `pick`, `inside`: as of sampleEnvironment.
DistantLight sampleDistantLight(Light light, real2 pick, real2 inside) {
    DistantLight distant = sampleDirectional(light);
    if (hasLightKind(light, FEATURE_ENVIRONMENT, LIGHT_ENVIRONMENT)) distant = sampleEnvironmentLight(pick, inside);
    return distant;
}

/// The start of a light path.
Emission sampleEmission(real4 u, real4 v) {
    Emission emission = Emission(real3(0.0), real3(0.0), real3(0.0), 0.0, 0.0, NO_INDEX, false, false);
    real q;
    Light light = loadLight(pickLight(u.xy, q));
    if (isAreaLight(light)) emitFromArea(emission, light, u.zw, v.xyz);
    if (hasLightKind(light, FEATURE_LIGHT_POINTS, LIGHT_POINT)) emitFromPointLight(emission, light, u.zw);
    if (hasLightKind(light, FEATURE_LIGHT_SPOTS, LIGHT_SPOT)) emitFromSpot(emission, light, u.zw);
    if (isDistantLight(light)) emitFromDistant(emission, light, sampleDistantLight(light, u.zw, v.zw), v.xy);
    return emission;
}

/// A next-event sample for a receiver at `position`. `more` is used by environment maps alone.
DirectLight sampleDirect(real3 position, real4 u, real2 more) {
    DirectLight direct = DirectLight(position, real3(0.0), real3(0.0), 1.0, 1.0, NO_INDEX, false, false);
    real q;
    Light light = loadLight(pickLight(u.xy, q));
    if (isAreaLight(light)) sampleArea(direct, light, position, u.zw);
    if (hasLightKind(light, FEATURE_LIGHT_POINTS, LIGHT_POINT)) samplePointLight(direct, light, position);
    if (hasLightKind(light, FEATURE_LIGHT_SPOTS, LIGHT_SPOT)) sampleSpot(direct, light, position);
    if (isDistantLight(light)) sampleDistant(direct, light, sampleDistantLight(light, u.zw, more), position);
    return direct;
}
#endif
