// Stored light vertices, three records: position and primitive; throughput, dVCM; dVC, direction and path length.
#ifndef ANTIPODE_VERTEX
#define ANTIPODE_VERTEX
#include "lib/path_vertex.glsl"

layout(set = 0, binding = BIND_VERTEX_POSITIONS) uniform usamplerBuffer vertexPositions;
layout(set = 0, binding = BIND_VERTEX_DATA) uniform usamplerBuffer vertexData;

/// What a stored vertex tells of the light path that made it: all that a merge takes from it.
struct LightArrival {
    real3 throughput;  // before the vertex scatters
    real endDensity;   // dVCM times the sample count of the technique that it stands for
    real dVC;
    real3 back;         // unit, to where the light path came from
    uint edges;         // from the light
    uvec2 mediaAcross;  // before and beyond, with FEATURE_INTERFACES
    bool dispersed;     // on the way to the vertex, with FEATURE_DISPERSION
};

/// The vertex at which the light path of this slot arrived, as it is stored.
void packLightVertex(const PathVertex v, uint slot, out Record position, out Record carried, out Record rest) {
    // The spare bits of the path length hold the media of the interface, and whether the way here disperses.
    uint tag = pathLength(v.path);
    if (feature(FEATURE_INTERFACES)) {
        uvec2 mediaAcross = interfaceMedia(slot);
        tag |= (mediaAcross.x << 16) | (mediaAcross.y << 24);
    }
    if (feature(FEATURE_DISPERSION) && isDispersed(v.path)) tag |= VERTEX_DISPERSED;
    position = packRecord(v.position, v.primitive);
    carried = packRecord(real4(v.path.throughput, v.endDensity));
    rest = packRecord(real3(v.path.dVC, packDirection(v.back)), tag);
}

LightArrival loadLightArrival(uint index) {
    Record carried = fetchRecord(vertexData, 2u * index), rest = fetchRecord(vertexData, 2u * index + 1u);
    real3 more = recordVector(rest);
    uint tag = recordTag(rest);
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
    return LightArrival(recordVector(carried), recordFourth(carried), more.x, unpackDirection(more.yz), tag,
                        mediaAcross, dispersed);
}

/// A stored vertex as one that paths can be joined at. Of its path only what joints ask for.
PathVertex loadLightVertex(uint index) {
    LightArrival arrival = loadLightArrival(index);
    Record position = fetchRecord(vertexPositions, index);
    uint primitive = recordTag(position);
    bool point = isMediumPoint(primitive);
    Surface surface = surfaceAtPosition(point ? 0u : primitive, recordVector(position));
    PathVertex y = surfaceVertex(surface, arrival.back, arrival.mediaAcross, true);
    if (point) placeInMedium(y, recordVector(position), primitive);
    y.path.throughput = arrival.throughput;
    y.path.dVC = arrival.dVC;
    y.path.flags = arrival.edges | (arrival.dispersed ? PATH_DISPERSED : 0u) | (point ? PATH_IN_MEDIUM : 0u);
    y.endDensity = arrival.endDensity;
    return y;
}
#endif
