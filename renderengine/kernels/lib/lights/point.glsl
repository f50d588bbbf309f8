// Point lights of the same intensity in all directions.
#ifndef ANTIPODE_POINT_LIGHT
#define ANTIPODE_POINT_LIGHT
#include "lib/lights/light_record.glsl"

/// The start of a path from a point in a direction; pdf: P_emit.
void emitFromPoint(inout Emission emission, Light light, real3 direction, real3 intensity, real pdf) {
    emission.origin = light.positionOrDirection;
    emission.direction = direction;
    emission.throughput = intensity / pdf;
    emission.dVCM = light.pick / pdf;
    emission.valid = true;
}

/// A point of this intensity towards the receiver at `position`.
void samplePoint(inout DirectLight direct, Light light, real3 position, real3 intensity, real pdfDirection) {
    direct.target = light.positionOrDirection;
    real3 d = direct.target - position;
    real d2 = dot(d, d);
    direct.direction = d * inversesqrt(d2);
    direct.pdf = light.pick * d2;
    direct.emitRatio = pdfDirection / d2;
    direct.value = intensity / direct.pdf;
    direct.delta = true;
    direct.valid = d2 > 0.0;
}

void emitFromPointLight(inout Emission emission, Light light, real2 u) {
    emitFromPoint(emission, light, sampleSphere(u), light.value, light.pick * 0.25 / PI);
}
void samplePointLight(inout DirectLight direct, Light light, real3 position) {
    samplePoint(direct, light, position, light.value, 0.25 / PI);
}
#endif
