#version 460
#extension GL_GOOGLE_include_directive : require
// Connects a camera vertex to one light vertex drawn uniformly from all that the iteration stored
// (Davidovič et al. 2014); `stageIndex` − 1 tells which of the K draws this is.
#include "lib/common.glsl"
#include "lib/crop.glsl"
#include "lib/random.glsl"
#include "lib/vertex.glsl"

void main() {
    uint index = interleavedIndex();
    bool live = index < liveCount();
    uint slot = live ? queueEntry(index) : 0u;
    PathVertex x = loadPathVertex(slot);
    uint edges = pathLength(x.path);
    live = live && scatters(x);

    // A light vertex y.
    uint bits = randomBits(framePixel(push.pathBase + slot), 0, edges, RANDOM_CONNECT + push.stageIndex - 1u).x;
    uint choice = randomIndex(bits, push.vertexCount);
    LightVertex y = loadLightVertexData(choice);
    Record yPosition = fetchRecord(vertexPositions, choice);
    Surface ySurface = surfaceAtPosition(recordTag(yPosition), recordVector(yPosition));
    Bsdf yBsdf = loadBsdf(ySurface, y.direction);
    if (feature(FEATURE_INTERFACES)) placeInterface(yBsdf, y.direction, y.mediaAcross);

    // The edge between them, and both BSDFs along it.
    real3 d = ySurface.position - x.surface.position;
    real distance2 = dot(d, d);
    real3 towards = d * inversesqrt(distance2);
    real pdfX, reverseX, pdfY, reverseY;
    real3 fX = evalBsdf(x.bsdf, x.back, towards, false, pdfX, reverseX);
    real3 fY = evalBsdf(yBsdf, y.direction, -towards, true, pdfY, reverseY);

    // Its contribution, weighted.
    real w = weightConnection(x.path, pdfX, reverseX, areaCosine(x, towards), y.endDensity, y.dVC, pdfY, reverseY,
                              abs(dot(towards, yBsdf.ng)), distance2);
    real3 value = x.path.throughput * fX * fY * y.throughput *
                  (scatterCosine(x, towards, false) * adjointCosine(yBsdf, y.direction, -towards) / distance2 * w *
                   push.connectScale);
    if (feature(FEATURE_ABSORPTION)) value *= transmittanceTowards(slot, x, towards, sqrt(distance2));
    bool wanted = live && wantedLength(edges + 1u + y.edges) && wantedTechnique(y.edges + 1u, edges + 1u);
    bool apart = wanted && distance2 > 0.0;
    countInvalid(SOURCE_CONNECTION, apart && nonFinite(value), apart && any(lessThan(value, real3(0.0))),
                 wanted && !apart);
    wanted = apart && max(value.x, max(value.y, value.z)) > 0.0;
    if (feature(FEATURE_INTERFACES) && wanted) storeShadowMedium(slot, x, towards);
    if (wanted)
        storeShadowRay(slot, leaveSurface(x.surface, towards), x.surface.primitive, leaveSurface(ySurface, -towards),
                       ySurface.primitive, seenAtWavelength(value, isDispersed(x) || y.dispersed || yBsdf.dispersive),
                       0u);
    enqueueShadowRay(wanted, push.stageIndex, slot);
}
