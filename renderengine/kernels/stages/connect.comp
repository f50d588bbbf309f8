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
    PathVertex x = loadPathVertex(slot, false);
    uint edges = pathLength(x.path);
    live = live && scatters(x);

    // A light vertex y.
    uint bits = randomBits(framePixel(push.pathBase + slot), 0, edges, RANDOM_CONNECT + push.stageIndex - 1u).x;
    PathVertex y = loadLightVertex(randomIndex(bits, push.vertexCount));
    uint lightEdges = pathLength(y.path);

    // The edge between them, and what both scatter along it.
    real3 d = y.position - x.position;
    real distance2 = dot(d, d);
    real3 towards = d * inversesqrt(distance2);
    real pdfX, reverseX, pdfY, reverseY;
    real3 fX = evalVertex(x, towards, pdfX, reverseX);
    real3 fY = evalVertex(y, -towards, pdfY, reverseY);

    // Its contribution, weighted.
    uint medium = mediumTowards(slot, x, towards);
    real w =
        weightConnection(x.path, pdfX, reverseX, arrivalDensity(x, towards, medium, sqrt(distance2)), y.path,
                         y.endDensity, pdfY, reverseY, arrivalDensity(y, -towards, medium, sqrt(distance2)), distance2);
    real3 value = x.path.throughput * fX * fY * y.path.throughput *
                  (scatterCosine(x, towards) * scatterCosine(y, -towards) / distance2 * w * push.connectScale);
    if (hasExtinction()) value *= transmittance(medium, sqrt(distance2));
    bool wanted = live && wantedLength(edges + 1u + lightEdges) && wantedTechnique(lightEdges + 1u, edges + 1u);
    bool apart = wanted && distance2 > 0.0;
    countInvalid(SOURCE_CONNECTION, apart && nonFinite(value), apart && any(lessThan(value, real3(0.0))),
                 wanted && !apart);
    wanted = apart && max(value.x, max(value.y, value.z)) > 0.0;
    if (feature(FEATURE_INTERFACES) && wanted) storeShadowMedium(slot, medium);
    if (wanted)
        storeShadowRay(slot, leaveVertex(x, towards), x.primitive, leaveVertex(y, -towards), y.primitive,
                       seenAtWavelength(value, isDispersed(x) || isDispersed(y)), 0u);
    enqueueShadowRay(wanted, push.stageIndex, slot);
}
