#version 460
#extension GL_GOOGLE_include_directive : require
// a: random numbers    out a: point of the lens, in units of its right and up
#include "lib/common.glsl"
#include "lib/camera.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    real3 p = sampleLens(inputA[i].xy) - job.cameraPosition.xyz;
    outputA[i] = vec4(dot(p, job.cameraRight.xyz), dot(p, job.cameraUp.xyz), dot(p, job.cameraForward.xyz), 0.0);
}
