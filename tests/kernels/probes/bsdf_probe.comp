#version 460
#extension GL_GOOGLE_include_directive : require
// VARIANT 0, evalBsdf:   a: wKnown, primitive    b: wNew, 1 for adjoint    out a: value, pdf    out b: reverse pdf
// VARIANT 1, sampleBsdf: a: wKnown, primitive    b: three random numbers    c.x: 1 for adjoint
//                        out a: direction, 1 valid + 2 specular + 4 drawn with zero density    out b: value, pdf    out
//                        c: reverse pdf
#include "lib/common.glsl"
#include "lib/bsdf.glsl"
#include "probe.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    real3 wKnown = inputA[i].xyz;
    Surface s = surfaceAt(floatBitsToUint(inputA[i].w), 0.25, 0.25, real3(0.0));
    Bsdf b = loadBsdf(s, wKnown);
    if (VARIANT == 0u) {
        real pdf, reversePdf;
        real3 value = evalBsdf(b, wKnown, inputB[i].xyz, inputB[i].w != 0.0, pdf, reversePdf);
        outputA[i] = vec4(value, pdf);
        outputB[i] = vec4(reversePdf, 0.0, 0.0, 0.0);
    } else {
        BsdfSample r = sampleBsdf(b, wKnown, inputC[i].x != 0.0, inputB[i].xyz);
        outputA[i] = vec4(r.direction, (r.valid ? 1.0 : 0.0) + (r.specular ? 2.0 : 0.0) + (r.zeroPdf ? 4.0 : 0.0));
        outputB[i] = vec4(r.value, r.pdf);
        outputC[i] = vec4(r.reversePdf, 0.0, 0.0, 0.0);
    }
}
