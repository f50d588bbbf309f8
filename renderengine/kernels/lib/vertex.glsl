// Stored light vertices, 48 bytes: position and primitive; throughput, dVCM; dVC, direction and path length.
#ifndef ANTIPODE_VERTEX
#define ANTIPODE_VERTEX
#include "lib/frame.glsl"

layout(set = 0, binding = BIND_VERTEX_POSITIONS) uniform usamplerBuffer vertexPositions;
layout(set = 0, binding = BIND_VERTEX_DATA) uniform usamplerBuffer vertexData;

struct LightVertex {
    real3 throughput;   // before the BSDF
    real dVCM;          // times the sample count of the technique that it stands for
    real dVC;
    real3 direction;    // unit, back along the light path
    uint length_;       // edges from the light
};

LightVertex loadLightVertexData(uint index) {
    uvec4 a = texelFetch(vertexData, int(2u * index)), b = texelFetch(vertexData, int(2u * index + 1u));
    return LightVertex(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.x), unpackDirection(b.zw), unpackNumber(b.zw));
}
#endif
