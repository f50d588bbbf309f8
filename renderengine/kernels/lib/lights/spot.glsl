// Spot lights: full intensity inside the inner cone, none outside the outer one, sampled uniformly in the latter.
// Angles are versines, 1 − cosine: the cosine of a narrow cone would round to 1.
#ifndef ANTIPODE_SPOT_LIGHT
#define ANTIPODE_SPOT_LIGHT
#include "lib/lights/point.glsl"

/// Versines of the angle to the axis and of the half-angles. Clamped, it is the falloff's definition.
real spotFalloff(real versine, real versineInner, real versineOuter) {
    real t = versineInner < versineOuter ? clamp((versineOuter - versine) / (versineOuter - versineInner), 0.0, 1.0)
                                         : (versine <= versineOuter ? 1.0 : 0.0);
    return t * t;
}

real spotSolidAngle(Light light) { return 2.0 * PI * light.versineOuter; }

void emitFromSpot(inout Emission emission, Light light, real2 u) {
    real versine = light.versineOuter * u.x;
    real s = sqrt(max(versine * (2.0 - versine), 0.0)), phi = 2.0 * PI * (u.y - 0.5);
    real3 direction = toWorld(real3(s * cos(phi), s * sin(phi), 1.0 - versine), light.axis);
    real3 intensity = light.value * spotFalloff(versine, light.versineInner, light.versineOuter);
    emitFromPoint(emission, light, direction, intensity, light.pick / spotSolidAngle(light));
}

void sampleSpot(inout DirectLight direct, Light light, real3 position) {
    real3 d = light.positionOrDirection - position;
    real3 offAxis = d * inversesqrt(dot(d, d)) + light.axis;
    real falloff = spotFalloff(0.5 * dot(offAxis, offAxis), light.versineInner, light.versineOuter);
    samplePoint(direct, light, position, light.value * falloff, 1.0 / spotSolidAngle(light));
}
#endif
