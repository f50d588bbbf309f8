#version 460
#extension GL_GOOGLE_include_directive : require
// A light path at a surface: stores the vertex, prepares its splat to the camera, and scatters.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/hit.glsl"
#include "lib/camera.glsl"

layout(set = 0, binding = BIND_WAVE_VERTICES, std430) writeonly buffer WaveVertices { Record waveVertices[]; };

void main() {
    uint index = interleavedIndex();
    bool live = index < liveCount();
    uint slot = live ? queueEntry(index) : 0u;
    uint id = push.pathBase + slot;
    SurfaceHit h = loadSurfaceHit(slot);
    live = live && h.valid;
    uint edges = pathLength(h.path);
    real endCount = lightEndCount(edges);
    bool store = live && !h.bsdf.specular && !h.bsdf.black && dot(h.back, h.bsdf.n) > 0.0 && edges < job.lengths.y;

    bool splat = false;
    if (term(TERM_SPLAT)) {
        bool wanted = store && push.splatEnabled != 0u && wantedLength(edges + 1u) && wantedTechnique(edges + 1u, 1u);
        real3 lens = sampleLens(randomBlock(id, RANDOM_LIGHT, edges, RANDOM_SPLAT).xy);
        real3 toCamera = lens - h.surface.position;
        real d2 = dot(toCamera, toCamera);
        toCamera *= inversesqrt(d2);
        real cosCamera = -dot(toCamera, job.cameraForward.xyz);
        real2 raster = rasterPosition(lens, -toCamera, cosCamera);
        splat = wanted && cosCamera > 0.0 && raster.x >= 0.0 && raster.y >= 0.0 && raster.x < real(job.image.x) &&
                raster.y < real(job.image.y);
        uvec2 pixelAt = min(uvec2(max(raster, real2(0.0))), job.image.xy - 1u);
        real pdf, reversePdf;
        real3 f = evalBsdf(h.bsdf, h.back, toCamera, true, pdf, reversePdf);
        real imageFactor = cameraPdf(cosCamera) / d2;
        real toSurface = imageFactor * abs(dot(toCamera, h.bsdf.ng));
        // eq. 46, 47
        real w = misWeight(
            toSurface / push.lightPathCount * (push.mergeCount + endCount * h.path.dVCM + reversePdf * h.path.dVC),
            0.0);
        real3 value =
            h.path.throughput * f * (imageFactor * adjointCosine(h.bsdf, h.back, toCamera) * w / push.lightPathCount);
        countInvalid(SOURCE_SPLAT, splat && nonFinite(value), splat && any(lessThan(value, real3(0.0))),
                     wanted && !(d2 > 0.0));
        splat = splat && max(value.x, max(value.y, value.z)) > 0.0;
        if (splat)
            storeShadowRay(slot, leaveSurface(h.surface, toCamera), h.surface.primitive, lens, NO_INDEX, value,
                           pixelAt.y * job.image.x + pixelAt.x);
        enqueueShadowRay(splat, 0u, slot);
    }
    if (term(TERM_CONNECT | TERM_MERGE) && store) {
        uint at = VERTEX_RECORDS * index;
        waveVertices[at] = packRecord(h.surface.position, h.surface.primitive);
        waveVertices[at + 1u] = packRecord(real4(h.path.throughput, endCount * h.path.dVCM));
        waveVertices[at + 2u] = packRecord(real3(h.path.dVC, packDirection(h.back)), edges);
    }

    BsdfSample s = sampleBsdf(h.bsdf, h.back, true, randomBlock(id, RANDOM_LIGHT, edges, RANDOM_SCATTER));
    bool alive = live && s.valid && edges + 1u < job.lengths.y;
    real3 factor = s.specular ? s.value : s.value * (adjointCosine(h.bsdf, h.back, s.direction) / s.pdf);
    scatterMis(h.path, h.bsdf, s, h.back, endCount);
    h.path.throughput *= factor;
    h.path.origin = leaveSurface(h.surface, s.direction);
    h.path.originPrimitive = h.surface.primitive;
    h.path.direction = s.direction;
    h.path.flags = (edges + 1u) | (s.specular ? h.path.flags & PATH_SPECULAR : 0u);
    countInvalid(SOURCE_LIGHT_SCATTER,
                 alive && (nonFinite(h.path.throughput) || nonFinite(s.direction) || isnan(h.path.dVCM + h.path.dVC)),
                 alive && any(lessThan(h.path.throughput, real3(0.0))), live && s.zeroPdf);
    alive = alive && max(h.path.throughput.x, max(h.path.throughput.y, h.path.throughput.z)) > 0.0;
    if (alive) storePath(slot, h.path);
    if (!term(TERM_CONNECT | TERM_MERGE))
        enqueuePath(alive, slot);
    else if (index < liveCount())
        slotFlags[index] = (alive ? SLOT_ALIVE : 0u) | (store ? SLOT_STORED : 0u);
}
