// A light as the scene stores it, and the samples that every kind of light gives: the start of a light path, a point
// seen from a surface, and what an emitter that a path met would have cost to sample. Each file beside this one holds
// one kind. Densities follow the table in Georgiev 2012: P = q·p, with q the probability of picking the light.
#ifndef ANTIPODE_LIGHT_RECORD
#define ANTIPODE_LIGHT_RECORD
#include "lib/frame.glsl"
#include "lib/surface.glsl"

layout(set = 0, binding = BIND_LIGHTS) uniform usamplerBuffer lights;

struct Light {
    uint kind;
    uint primitive, material;         // of emitters
    real pick;                        // q
    real3 positionOrDirection;        // of points and spots; of directional lights, the way that light travels
    real3 value;                      // intensity, irradiance
    real3 axis;                       // of spots
    real versineInner, versineOuter;  // 1 − cosine of their half-angles
};

struct Emission {  // the start of a light path
    real3 origin, direction;
    real3 throughput;  // emitted·cosine / P_emit
    real dVCM, dVC;    // P_dir/P_emit, cosine/P_emit (0 for delta lights): without sample counts
    uint primitive;
    bool infinite, valid;
};

struct DirectLight {  // a next-event sample
    real3 target, direction;
    real3 value;     // radiance or intensity over (q·pdf), distance included
    real pdf;        // q·p in solid angle at the receiver
    real emitRatio;  // P_emit/(q·p·cosine at the light)
    uint primitive;
    bool delta, valid;
};

struct EmitterHit {  // an emitter that a camera path met
    real3 radiance;
    real pdfNextEvent;  // P_dir: of area, or of solid angle at infinity
    real pdfEmit;       // P_emit
    bool valid;         // false on the dark side
};

real pickProbability(uint light) { return uintBitsToFloat(texelFetch(lights, int(light * LIGHT_TEXELS)).w); }

Light loadLight(uint light) {
    uvec4 l0 = texelFetch(lights, int(light * LIGHT_TEXELS)), l1 = texelFetch(lights, int(light * LIGHT_TEXELS + 1u)),
          l2 = texelFetch(lights, int(light * LIGHT_TEXELS + 2u)),
          l3 = texelFetch(lights, int(light * LIGHT_TEXELS + 3u));
    return Light(l0.x, l0.y, l0.z, uintBitsToFloat(l0.w), uintBitsToFloat(l1.xyz), uintBitsToFloat(l2.xyz),
                 uintBitsToFloat(l3.xyz), uintBitsToFloat(l0.y), uintBitsToFloat(l3.w));
}

/// Index and fraction of a draw from an alias table of `count` entries, from two numbers in [0,1): 32 random bits,
/// since 24 would leave the fraction too few for tables of many entries.
uint aliasSlot(real2 u, uint count, out real fraction) {
    uint bits = (uint(u.x * 16777216.0) << 8) | uint(u.y * 256.0);
    uint index, low;
    umulExtended(bits, count, index, low);
    fraction = real(low >> 8) * 5.9604644775390625e-8;
    return index;
}
#endif
