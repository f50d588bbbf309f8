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
void emitFromDistant(inout Emission emission, Light light, DistantLight from, real2 u) {
    real radius = job.sceneCenter.w;
    real pdfDisk = 1.0 / (PI * radius * radius);
    real pdf = light.pick * from.pdf * pdfDisk;
    emission.direction = -from.direction;
    real2 d = sampleDisk(u);
    real3 t, b;
    tangentFrame(emission.direction, t, b);
    emission.origin = job.sceneCenter.xyz + radius * (d.x * t + d.y * b - emission.direction);
    emission.throughput = from.value / pdf;
    emission.dVCM = light.pick * from.pdf / pdf;
    emission.dVC = from.delta ? 0.0 : 1.0 / pdf;
    emission.infinite = true;
    emission.valid = from.pdf > 0.0;
}

void sampleDistant(inout DirectLight direct, Light light, DistantLight from, real3 position) {
    real radius = job.sceneCenter.w;
    direct.direction = from.direction;
    direct.delta = from.delta;
    direct.pdf = light.pick * from.pdf;
    direct.emitRatio = 1.0 / (PI * radius * radius);
    direct.value = from.value / direct.pdf;
    // Beyond everything: twice the bounding sphere's diameter.
    direct.target = position + direct.direction * (4.0 * radius);
    direct.valid = from.pdf > 0.0;
}
#endif
