// Directional lights: parallel light of an irradiance, from beyond the scene.
#ifndef ANTIPODE_DIRECTIONAL_LIGHT
#define ANTIPODE_DIRECTIONAL_LIGHT
#include "lib/lights/distant.glsl"

DistantLight sampleDirectional(Light light) { return DistantLight(-light.positionOrDirection, light.value, 1.0, true); }
#endif
