// Writes the arguments of an indirect dispatch of `count` values to the first three.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "test_layout.glsl"

void main() {
    if (gl_GlobalInvocationID.x != 0) return;
    values[0] = (push.count + 63) / 64;
    values[1] = 1;
    values[2] = 1;
}
