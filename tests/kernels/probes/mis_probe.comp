#version 460
#extension GL_GOOGLE_include_directive : require
// VARIANT 0, misWeight: a: densities pA, pB of two techniques    out a: weights of A and of B
// VARIANT 1, all weights of a path of k edges and given densities, vertices 0 … k−2 from the light, element i of its
// own:
//   a[0]: k, 1 delta + 2 infinite light (bits), P_dir/P_emit, cosine at the light/P_emit
//   a[1]: P_dir, P_emit, distance and cosine of the light
//   a[2]: q·p per solid angle and P_emit/(q·p·cosine) at vertex 0, the camera's density per solid angle
//   a[16 + e]: of the edge to vertex e: density of the flight to it, and of that the other way
//   b[i]: density towards the camera and towards the light, cosine of the latter and of the former
//   c[i]: distance to the next vertex, 1 specular + 2 transmitted + 4 in a medium (bits), index towards the camera over
//   the other
//   out a[s]: weight with s light vertices    out b[i]: of the merge at vertex i
#include "lib/common.glsl"
#include "lib/mis.glsl"
#include "probe.glsl"

const uint PATH_STRIDE = 32, FLIGHTS = 16;

/// All but the densities.
void start(out Path path, bool infinite) {
    path.origin = path.direction = path.throughput = real3(0.0);
    path.originPrimitive = NO_INDEX;
    path.flags = 1u | PATH_SPECULAR | (infinite ? PATH_FROM_INFINITY : 0u);
    path.lossless = 1.0;
}

/// `flight`: its density to the vertex, and the other way. `kind` as in c.
void arriveAt(inout Path path, real distance_, real cosGeometric, real2 flight, uint kind) {
    arrive(path, distance_, cosGeometric);
    passMedium(path, flight.x, flight.y);
    if ((kind & 4u) != 0u) path.flags |= PATH_IN_MEDIUM;
}

/// `kind`: as in c; `eta`: index on the side left to over that of arrival.
void scatter(inout Path path, uint kind, real endDensity, real cosKnown, real cosNew, real pdf, real reversePdf,
             real eta) {
    scatterDensities(path, (kind & 1u) != 0u, endDensity, cosKnown, cosNew, pdf, reversePdf, (kind & 2u) != 0u, eta);
    path.flags = (path.flags & ~PATH_IN_MEDIUM) + 1u;
}

/// Of the edge to vertex e, from the light's side.
real2 flightTo(uint at, uint e) { return inputA[at + FLIGHTS + e].xy; }

void weighPath(uint at) {
    uint edges = floatBitsToUint(inputA[at].x), light = floatBitsToUint(inputA[at].y), count = edges - 1u;
    bool delta = (light & 1u) != 0u, infinite = (light & 2u) != 0u;
    real pdfDirect = inputA[at + 1].x, pdfEmit = inputA[at + 1].y;
    real lightDistance = inputA[at + 1].z, lightCosine = inputA[at + 1].w;

    // The light path at every vertex, and its splat.
    Path lightPath[PATH_STRIDE], path;
    start(path, infinite);
    startLightPath(path, inputA[at].z, inputA[at].w);
    for (uint i = 0u; i < count; ++i) {
        vec4 b = inputB[at + i], c = inputC[at + i];
        uint kind = floatBitsToUint(c.y);
        arriveAt(path, i == 0u ? lightDistance : inputC[at + i - 1u].x, b.z, flightTo(at, i), kind);
        lightPath[i] = path;
        if (i + 1u == count)
            outputA[at + edges].x =
                weightSplat(path, inputA[at + 2].z * b.w * flightTo(at, edges - 1u).y / (c.x * c.x), b.y);
        scatter(path, kind, lightEndDensity(path), b.z, b.w, b.x, b.y, c.z);
    }

    // The camera path: what it makes of the light path at each vertex, and of the light itself.
    start(path, false);
    startCameraPath(path, inputA[at + 2].z);
    for (uint j = count; j > 0u; --j) {
        uint i = j - 1u;
        vec4 b = inputB[at + i], c = inputC[at + i];
        uint kind = floatBitsToUint(c.y);
        arriveAt(path, c.x, b.w, flightTo(at, i + 1u).yx, kind);
        real2 flight = flightTo(at, i);  // of the edge to the light's side
        outputB[at + i].x =
            weightMerge(cameraEndDensity(path), path.dVC, lightEndDensity(lightPath[i]), lightPath[i].dVC, b.y, b.x);
        if (i == 0u) {
            outputA[at + 1u].x =
                weightNextEvent(path, delta, inputA[at + 2].x, inputA[at + 2].y, b.z * flight.x, b.y * flight.y, b.x);
        } else {
            vec4 y = inputB[at + i - 1u];
            real d = inputC[at + i - 1u].x;
            outputA[at + j].x = weightConnection(path, b.y, b.x, b.z * flight.x, lightPath[i - 1u],
                                                 lightEndDensity(lightPath[i - 1u]), y.x, y.y, y.w * flight.y, d * d);
        }
        scatter(path, kind, cameraEndDensity(path), b.w, b.z, b.y, b.x, 1.0 / c.z);
    }
    if (!infinite) arriveAt(path, lightDistance, lightCosine, flightTo(at, 0u).yx, 0u);
    outputA[at].x = weightEmitterHit(path, pdfDirect, pdfEmit);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (VARIANT == 0u) {
        if (i >= push.elementCount) return;
        real a = inputA[i].x, b = inputA[i].y;
        outputA[i] = vec4(misWeight(b / a, 0.0), misWeight(0.0, a / b), 0.0, 0.0);
    } else if (i * PATH_STRIDE < push.elementCount) {
        weighPath(i * PATH_STRIDE);
    }
}
