// Value i becomes the sum of texel i's four components, all whole numbers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "test_layout.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < push.count) values[i] = uint(dot(texelFetch(table, int(i)), vec4(1.0)));
}
