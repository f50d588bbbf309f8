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
    real3 direction;    // unit, back along the light path
    uint edges;         // from the light
    uvec2 mediaAcross;  // before and beyond, with FEATURE_INTERFACES
    bool dispersed;     // on the way to the vertex, with FEATURE_DISPERSION
};

/// The tag of a stored vertex: path length, and the media of its interface in the spare bits.
uint packVertexTag(uint edges, uvec2 mediaAcross) { return edges | (mediaAcross.x << 16) | (mediaAcross.y << 24); }

LightVertex loadLightVertexData(uint index) {
    Record a = fetchRecord(vertexData, 2u * index), b = fetchRecord(vertexData, 2u * index + 1u);
    real3 rest = recordVector(b);
    uint tag = recordTag(b);
    uvec2 mediaAcross = uvec2(0u);
    if (feature(FEATURE_INTERFACES)) {
        mediaAcross = uvec2((tag >> 16) & GREATEST_MEDIUM, tag >> 24);
        tag &= PATH_LENGTH_MASK;
    }
    bool dispersed = false;
    if (feature(FEATURE_DISPERSION)) {
        dispersed = (tag & VERTEX_DISPERSED) != 0u;
        tag &= ~VERTEX_DISPERSED;
    }
    return LightVertex(recordVector(a), recordFourth(a), rest.x, unpackDirection(rest.yz), tag, mediaAcross, dispersed);
}
#endif
