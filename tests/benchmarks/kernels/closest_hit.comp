#version 460
#extension GL_GOOGLE_include_directive : require
// The nearest hit of rays that lie one after the other: the intersect stage without the paths' queues around it.
#include "lib/common.glsl"
#include "lib/traversal.glsl"

layout(set = 0, binding = BIND_PATHS) uniform usamplerBuffer rays;  // two texels each: origin, direction
layout(set = 0, binding = BIND_HITS_OUT, std430) writeonly buffer HitsOut { uvec4 hitsOut[]; };

void main() {
    uint index = interleavedIndex();
    if (index >= push.elementCount) return;
    vec3 origin = uintBitsToFloat(texelFetch(rays, int(2u * index)).xyz);
    vec3 direction = uintBitsToFloat(texelFetch(rays, int(2u * index + 1u)).xyz);
    Hit hit = intersect(origin, direction, INFINITE_DISTANCE, NO_INDEX, NO_INDEX, false, SOURCE_CAMERA_TRACE, 0u);
    hitsOut[index] = uvec4(floatBitsToUint(hit.t), floatBitsToUint(hit.b1), floatBitsToUint(hit.b2), hit.primitive);
}
