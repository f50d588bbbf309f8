#version 460
#extension GL_GOOGLE_include_directive : require
// The functions of lib/transcendental.glsl in double; elements are pairs of doubles.
// a: x, y    out a: sin x, cos x    out b: exp x, log y (y > 0)    out c: atan(y, x), VARIANT 0: logOneMinus x, 1:
// oneMinusExp x
#include "lib/common.glsl"
#include "lib/transcendental.glsl"

layout(set = 0, binding = BIND_COUNT, std430) readonly buffer InputA { dvec2 inputA[]; };
layout(set = 0, binding = BIND_COUNT + 3, std430) writeonly buffer OutputA { dvec2 outputA[]; };
layout(set = 0, binding = BIND_COUNT + 4, std430) writeonly buffer OutputB { dvec2 outputB[]; };
layout(set = 0, binding = BIND_COUNT + 5, std430) writeonly buffer OutputC { dvec2 outputC[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.elementCount) return;
    double x = inputA[i].x, y = inputA[i].y;
    outputA[i] = dvec2(sin(x), cos(x));
    outputB[i] = dvec2(exp(x), log(y));
    outputC[i] = dvec2(atan(y, x), VARIANT == 0u ? logOneMinus(x) : oneMinusExp(x));
}
