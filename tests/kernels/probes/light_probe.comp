#version 460
#extension GL_GOOGLE_include_directive : require
// VARIANT 0, sampleEmission:   a, b: random numbers                out a: origin, valid + 2·infinite
//                              out b: direction, dVCM              out c: throughput, dVC
// VARIANT 1, sampleDirect:     a: position    b, c.xy: random numbers    out a: direction, valid + 2·delta
//                              out b: value, pdf                   out c: target, emitRatio
// VARIANT 2, pickLight:        a.xy: random numbers                out a: light (bits), q
// VARIANT 3, sampleEnvironment: a: random numbers                  out a: direction    out b: radiance, pdf
// VARIANT 4, evalEnvironment:  a: direction                        out b: radiance, pdf
#include "lib/common.glsl"
#include "lib/light.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    if (VARIANT == 0u) {
        Emission e = sampleEmission(inputA[i], inputB[i]);
        outputA[i] = vec4(e.origin, (e.valid ? 1.0 : 0.0) + (e.infinite ? 2.0 : 0.0));
        outputB[i] = vec4(e.direction, e.dVCM);
        outputC[i] = vec4(e.throughput, e.dVC);
    } else if (VARIANT == 1u) {
        DirectLight d = sampleDirect(inputA[i].xyz, inputB[i], inputC[i].xy);
        outputA[i] = vec4(d.direction, (d.valid ? 1.0 : 0.0) + (d.delta ? 2.0 : 0.0));
        outputB[i] = vec4(d.value, d.pdf);
        outputC[i] = vec4(d.target, d.emitRatio);
    } else if (VARIANT == 2u) {
        real q;
        uint light = pickLight(inputA[i].xy, q);
        outputA[i] = vec4(uintBitsToFloat(light), q, 0.0, 0.0);
    } else {
        real3 direction = inputA[i].xyz, value;
        real pdf;
        if (VARIANT == 3u)
            direction = sampleEnvironment(inputA[i].xy, inputA[i].zw, value, pdf);
        else
            value = evalEnvironment(direction, pdf);
        outputA[i] = vec4(direction, 0.0);
        outputB[i] = vec4(value, pdf);
    }
}
