#version 460
#extension GL_GOOGLE_include_directive : require
// Finds the nearest surface along the ray of every live path, or where it is scattered before; `stageIndex` is the
// source of its events.
#include "lib/common.glsl"
#include "lib/crop.glsl"
#include "lib/media.glsl"
#include "lib/random.glsl"
#include "lib/state.glsl"
#include "lib/traversal.glsl"

void main() {
    uint index = interleavedIndex();
    if (index >= liveCount()) return;
    uint slot = queueEntry(index);
    Record origin = fetchRecord(paths, slot * PATH_RECORDS), direction = fetchRecord(paths, slot * PATH_RECORDS + 1u);
    uint medium = feature(FEATURE_INTERFACES) ? topRank(media[MEDIA_TEXELS * slot]) : 0u;
    // The free flight in a medium that scatters ends at a point in it where it meets nothing before.
    real flight = INFINITE_DISTANCE;
    if (feature(FEATURE_SCATTERING)) {
        uint id = push.pathBase + slot, edges = recordTag(direction) & PATH_LENGTH_MASK;
        bool light = push.stageIndex == SOURCE_LIGHT_TRACE;
        flight = sampleFlight(
            medium, randomBlock(light ? id : framePixel(id), light ? RANDOM_LIGHT : 0u, edges, RANDOM_FLIGHT).xy);
    }
    Hit hit = intersect(recordVector(origin), recordVector(direction), flight, recordTag(origin), NO_INDEX, false,
                        push.stageIndex, medium);
    if (hit.primitive == NO_INDEX && flight < INFINITE_DISTANCE) hit.primitive = MEDIUM_POINT | medium;
    hitsOut[slot] = packRecord(real3(hit.t, hit.b1, hit.b2), hit.primitive);
}
