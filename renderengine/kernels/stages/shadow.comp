#version 460
#extension GL_GOOGLE_include_directive : require
// Tests the visibility of a shadow queue's segments. VARIANT 0 adds what passes to the camera path's radiance,
// VARIANT 1 splats it onto the film.
#include "lib/common.glsl"
#include "lib/media.glsl"
#include "lib/state.glsl"
#include "lib/traversal.glsl"
#include "lib/film.glsl"

void main() {
    uint index = interleavedIndex();
    if (index >= counters[COUNTER_SHADOW_QUEUE + push.stageIndex]) return;
    uint slot = texelFetch(queues, int(2u * push.batchSize + index)).x;
    uint at = slot * SHADOW_RECORDS;
    Record origin = fetchRecord(shadow, at), segment = fetchRecord(shadow, at + 1u),
           carried = fetchRecord(shadow, at + 2u);
    uint source = VARIANT == 1u ? SOURCE_SPLAT : push.stageIndex == 0u ? SOURCE_NEXT_EVENT : SOURCE_CONNECTION;
    uint medium = feature(FEATURE_INTERFACES) ? media[MEDIA_TEXELS * slot + 2u].x : 0u;
    Hit hit = intersect(recordVector(origin), recordVector(segment), 1.0, recordTag(origin), recordTag(segment), true,
                        source, medium);
    if (hit.primitive != NO_INDEX) return;
    if (VARIANT == 1u)
        addSample(recordTag(carried), recordVector(carried), push.pathBase + slot, RANDOM_LIGHT, LAYER_SPLAT);
    else
        addRadiance(slot, push.stageIndex == 0u ? LAYER_NEXT_EVENT : LAYER_CONNECTION, recordVector(carried));
}
