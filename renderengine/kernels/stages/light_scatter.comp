#version 460
#extension GL_GOOGLE_include_directive : require
// A light path at its vertex: stores the vertex, prepares its splat to the camera, and scatters.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/vertex.glsl"
#include "lib/camera.glsl"

layout(set = 0, binding = BIND_WAVE_VERTICES, std430) writeonly buffer WaveVertices { Record waveVertices[]; };

void main() {
    uint index = interleavedIndex();
    bool live = index < liveCount();
    uint slot = live ? queueEntry(index) : 0u;
    PathVertex v = loadPathVertex(slot, true);
    live = live && v.valid;
    uint edges = pathLength(v.path);
    bool joins = live && scatters(v) && facesBack(v) && edges < job.lengths.y;
    bool store = joins && (term(TERM_CONNECT) || merges(v));

    // Splat: technique t = 1.
    if (term(TERM_SPLAT)) {
        bool wanted = joins && push.splatEnabled != 0u && wantedLength(edges + 1u) && wantedTechnique(edges + 1u, 1u);
        // The lens point, and the pixel through which it sees the vertex.
        real3 lens =
            cameraPointFor(v.position, randomBlock(push.pathBase + slot, RANDOM_LIGHT, edges, RANDOM_SPLAT).xy);
        real3 toCamera = lens - v.position;
        real distance2 = dot(toCamera, toCamera);
        toCamera *= inversesqrt(distance2);
        real cosCamera = -dot(toCamera, job.cameraForward.xyz);
        real2 raster = rasterPosition(lens, -toCamera, cosCamera);
        uvec2 frame = frameSize();
        bool splat = wanted && cosCamera > 0.0 && raster.x >= 0.0 && raster.y >= 0.0 && raster.x < real(frame.x) &&
                     raster.y < real(frame.y);
        uvec2 pixelAt = min(uvec2(max(raster, real2(0.0))), frame - 1u) - filmOrigin();
        if (feature(FEATURE_CROP)) splat = splat && all(lessThan(pixelAt, job.image.xy));  // before it: it wraps

        // What the pixel receives, weighted.
        real pdf, reversePdf;
        real3 f = evalVertex(v, toCamera, pdf, reversePdf);
        real imageFactor = cameraPdf(cosCamera) / (feature(FEATURE_ORTHOGRAPHIC) ? 1.0 : distance2);
        uint medium = mediumTowards(slot, v, toCamera);
        real w = weightSplat(v.path, imageFactor * arrivalDensity(v, toCamera, medium, sqrt(distance2)), reversePdf);
        real3 value = v.path.throughput * f * (imageFactor * scatterCosine(v, toCamera) * w / push.lightPathCount);
        if (hasExtinction()) value *= transmittance(medium, sqrt(distance2));
        countInvalid(SOURCE_SPLAT, splat && nonFinite(value), splat && any(lessThan(value, real3(0.0))),
                     wanted && !(distance2 > 0.0));
        splat = splat && max(value.x, max(value.y, value.z)) > 0.0;
        if (feature(FEATURE_INTERFACES) && splat) storeShadowMedium(slot, medium);
        if (splat)
            storeShadowRay(slot, leaveVertex(v, toCamera), v.primitive, lens, NO_INDEX,
                           seenAtWavelength(value, isDispersed(v)), pixelAt.y * job.image.x + pixelAt.x);
        enqueueShadowRay(splat, 0u, slot);
    }

    // The vertex that camera paths connect to and merge with.
    if (term(TERM_CONNECT | TERM_MERGE) && store) {
        uint at = VERTEX_RECORDS * index;
        packLightVertex(v, slot, waveVertices[at], waveVertices[at + 1u], waveVertices[at + 2u]);
    }

    // The way on: to no vertex from which only an emitter hit could follow.
    bool alive = continuePath(v, slot, job.lengths.y - 1u, live, SOURCE_LIGHT_SCATTER);
    if (!term(TERM_CONNECT | TERM_MERGE))
        enqueuePath(alive, slot);
    else if (index < liveCount())
        slotFlags[index] = (alive ? SLOT_ALIVE : 0u) | (store ? SLOT_STORED : 0u);
}
