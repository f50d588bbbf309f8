#version 460
#extension GL_GOOGLE_include_directive : require
// Connects a camera vertex to one light vertex drawn uniformly from all that the iteration stored
// (Davidovič et al. 2014); `stageIndex` − 1 tells which of the K draws this is.
#include "lib/common.glsl"
#include "lib/random.glsl"
#include "lib/hit.glsl"
#include "lib/vertex.glsl"

void main() {
    uint index = interleavedIndex();
    bool live = index < liveCount();
    uint slot = live ? queueEntry(index) : 0u;
    uint id = push.pathBase + slot;
    SurfaceHit h = loadSurfaceHit(slot);
    uint edges = pathLength(h.path);
    live = live && h.valid && !h.bsdf.specular && !h.bsdf.black;

    real u = randomBlock(id, 0, edges, RANDOM_CONNECT + push.stageIndex - 1u).x;
    uint choice = min(uint(u * real(push.vertexCount)), push.vertexCount - 1u);
    LightVertex y = loadLightVertexData(choice);
    Record yPosition = fetchRecord(vertexPositions, choice);
    Surface ySurface = surfaceAtPosition(recordTag(yPosition), recordVector(yPosition));
    Bsdf yBsdf = loadBsdf(ySurface, y.direction);

    real3 d = ySurface.position - h.surface.position;
    real d2 = dot(d, d);
    real3 towards = d * inversesqrt(d2);
    real pdfX, reverseX, pdfY, reverseY;
    real3 fX = evalBsdf(h.bsdf, h.back, towards, false, pdfX, reverseX);
    real3 fY = evalBsdf(yBsdf, y.direction, -towards, true, pdfY, reverseY);
    real cosX = abs(dot(towards, h.bsdf.ng)), cosY = abs(dot(towards, yBsdf.ng));
    // eq. 40, 41
    real lightRatio = pdfX * cosY / d2 * (push.mergeCount + y.dVCM + reverseY * y.dVC);
    real cameraRatio =
        pdfY * cosX / d2 * (push.mergeCount + cameraEndCount(edges) * h.path.dVCM + reverseX * h.path.dVC);
    real w = misWeight(lightRatio / push.connectCount, cameraRatio / push.connectCount);
    real3 value =
        h.path.throughput * fX * fY * y.throughput *
        (abs(dot(towards, h.bsdf.n)) * adjointCosine(yBsdf, y.direction, -towards) / d2 * w * push.connectScale);
    bool wanted = live && wantedLength(edges + 1u + y.length_) && wantedTechnique(y.length_ + 1u, edges + 1u);
    bool apart = wanted && d2 > 0.0;
    countInvalid(SOURCE_CONNECTION, apart && nonFinite(value), apart && any(lessThan(value, real3(0.0))),
                 wanted && !apart);
    wanted = apart && max(value.x, max(value.y, value.z)) > 0.0;
    if (wanted)
        storeShadowRay(slot, leaveSurface(h.surface, towards), h.surface.primitive, leaveSurface(ySurface, -towards),
                       ySurface.primitive, value, 0u);
    enqueueShadowRay(wanted, push.stageIndex, slot);
}
