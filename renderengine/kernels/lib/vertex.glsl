// Stored light vertices, three records: position and primitive; throughput, dVCM; dVC, direction and path length.
#ifndef ANTIPODE_VERTEX
#define ANTIPODE_VERTEX
#include "lib/path_vertex.glsl"

layout(set = 0, binding = BIND_VERTEX_POSITIONS) uniform usamplerBuffer vertexPositions;
layout(set = 0, binding = BIND_VERTEX_DATA) uniform usamplerBuffer vertexData;

struct LightVertex {
    real3 throughput;  // before the BSDF
    real endDensity;   // dVCM times the sample count of the technique that it stands for
    real dVC;
    real3 direction;  // unit, back along the light path
    uint edges;       // from the light
};

LightVertex loadLightVertexData(uint index) {
    Record a = fetchRecord(vertexData, 2u * index), b = fetchRecord(vertexData, 2u * index + 1u);
    real3 rest = recordVector(b);
    return LightVertex(recordVector(a), recordFourth(a), rest.x, unpackDirection(rest.yz), recordTag(b));
}
#endif
