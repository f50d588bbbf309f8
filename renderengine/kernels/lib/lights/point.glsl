// Point lights of the same intensity in all directions.
#ifndef ANTIPODE_POINT_LIGHT
#define ANTIPODE_POINT_LIGHT
#include "lib/lights/light_record.glsl"

/// The start of a path from a point in a direction; pdf: P_emit.
void emitFromPoint(inout Emission e, Light light, real3 direction, real3 intensity, real pdf) {
    e.origin = light.positionOrDirection;
    e.direction = direction;
    e.throughput = intensity / pdf;
    e.dVCM = light.pick / pdf;
    e.valid = true;
}

/// A point of this intensity towards the receiver at `position`.
void samplePoint(inout DirectLight r, Light light, real3 position, real3 intensity, real pdfDirection) {
    r.target = light.positionOrDirection;
    real3 d = r.target - position;
    real d2 = dot(d, d);
    r.direction = d * inversesqrt(d2);
    r.pdf = light.pick * d2;
    r.emitRatio = pdfDirection / d2;
    r.value = intensity / r.pdf;
    r.delta = true;
    r.valid = d2 > 0.0;
}

void emitFromPointLight(inout Emission e, Light light, real2 u) {
    emitFromPoint(e, light, sampleSphere(u), light.value, light.pick * 0.25 / PI);
}
void samplePointLight(inout DirectLight r, Light light, real3 position) {
    samplePoint(r, light, position, light.value, 0.25 / PI);
}
#endif
