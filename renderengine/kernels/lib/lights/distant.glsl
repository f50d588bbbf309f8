// Lights at infinity: what directional lights and the environment share once a direction is drawn.
#ifndef ANTIPODE_DISTANT_LIGHT
#define ANTIPODE_DISTANT_LIGHT
#include "lib/lights/light_record.glsl"

struct DistantLight {
    real3 direction;  // unit, to the light
    real3 value;      // radiance, or irradiance of a delta light
    real pdf;         // of the direction per solid angle; 1 for a delta light
    bool delta;
};

/// A path that enters the scene from the disk that its bounding sphere shows to the light.
void emitFromDistant(inout Emission e, Light light, DistantLight from, real2 u) {
    real radius = job.sceneCenter.w;
    real pdfDisk = 1.0 / (PI * radius * radius);
    real pdf = light.pick * from.pdf * pdfDisk;
    e.direction = -from.direction;
    real2 d = sampleDisk(u);
    real3 t, b;
    tangentFrame(e.direction, t, b);
    e.origin = job.sceneCenter.xyz + radius * (d.x * t + d.y * b - e.direction);
    e.throughput = from.value / pdf;
    e.dVCM = light.pick * from.pdf / pdf;
    e.dVC = from.delta ? 0.0 : 1.0 / pdf;
    e.infinite = true;
    e.valid = from.pdf > 0.0;
}

void sampleDistant(inout DirectLight r, Light light, DistantLight from, real3 position) {
    real radius = job.sceneCenter.w;
    r.direction = from.direction;
    r.delta = from.delta;
    r.pdf = light.pick * from.pdf;
    r.emitRatio = 1.0 / (PI * radius * radius);
    r.value = from.value / r.pdf;
    // Beyond everything: twice the bounding sphere's diameter.
    r.target = position + r.direction * (4.0 * radius);
    r.valid = from.pdf > 0.0;
}
#endif
