#version 460
#extension GL_GOOGLE_include_directive : require
// Finds the nearest surface along the ray of every live path; `stageIndex` is the source of its events.
#include "lib/common.glsl"
#include "lib/media.glsl"
#include "lib/state.glsl"
#include "lib/traversal.glsl"

void main() {
    uint index = interleavedIndex();
    if (index >= liveCount()) return;
    uint slot = queueEntry(index);
    Record origin = fetchRecord(paths, slot * PATH_RECORDS), direction = fetchRecord(paths, slot * PATH_RECORDS + 1u);
    uint medium = feature(FEATURE_INTERFACES) ? topRank(media[MEDIA_TEXELS * slot]) : 0u;
    Hit hit = intersect(recordVector(origin), recordVector(direction), INFINITE_DISTANCE, recordTag(origin), NO_INDEX,
                        false, push.stageIndex, medium);
    hitsOut[slot] = packRecord(real3(hit.t, hit.b1, hit.b2), hit.primitive);
}
