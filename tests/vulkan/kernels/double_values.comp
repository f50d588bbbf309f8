// Doubles the first `count` values, or multiplies them by what the host sets in the factor's place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "test_layout.glsl"

layout(constant_id = 0) const uint factor = 2;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < push.count) values[i] *= factor;
}
