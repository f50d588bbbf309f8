// Where a surface is: holes cut by the alpha of a base colour texture, and alpha that blends. Asked while a ray is
// traced, and of points sampled on emitters.
//
// What blends meets the part `coverage` of all segments, by a random number of the segment and the primitive: each
// segment is a fair sample of what passes, whichever technique asks. Sub-paths thus arrive with the chance `coverage`,
// and radiance of a point that none of them had to meet counts by it (lib/lights/area.glsl). Merges join two sub-paths
// that both had to meet the surface, and count its inverse once (stages/merge.comp). Weights leave all of it out of
// their densities.
#ifndef ANTIPODE_ALPHA
#define ANTIPODE_ALPHA
#include "lib/random.glsl"
#include "lib/scene_data.glsl"
#include "lib/texture.glsl"

/// A triangle's point.
TexturePoint trianglePoint(uint primitive, real b1, real b2) {
    if (!feature(FEATURE_ATTRIBUTES)) return TexturePoint(real2(0.0), primitive, b1, b2);
    uvec4 a2 = texelFetch(attributes, int(4u * primitive + 2u)), a3 = texelFetch(attributes, int(4u * primitive + 3u));
    real2 uv0 = uintBitsToFloat(uvec2(a2.y, a2.z)), uv1 = uintBitsToFloat(uvec2(a2.w, a3.x)),
          uv2 = uintBitsToFloat(a3.yz);
    return TexturePoint((1.0 - b1 - b2) * uv0 + b1 * uv1 + b2 * uv2, primitive, b1, b2);
}

/// Whether alpha decides where the material is, by a cut-off or blending.
bool hasHoles(uint material) {
    return (texelFetch(materials, int(material * MATERIAL_TEXELS)).w & MATERIAL_ALPHA) != 0u;
}
bool blends(uint material) {
    return feature(FEATURE_BLENDING) &&
           (texelFetch(materials, int(material * MATERIAL_TEXELS)).w & MATERIAL_BLENDS) != 0u;
}

/// The part of light that meets the material at a point: 0 or 1 unless it blends.
real coverageAt(uint material, TexturePoint point) {
    if (!hasHoles(material)) return 1.0;
    uint at = material * MATERIAL_TEXELS;
    uint texture_ = texelFetch(materials, int(at + 4u)).x;
    real given = uintBitsToFloat(texelFetch(materials, int(at + 3u)).z);
    real alpha = 1.0;
    if (!feature(FEATURE_BLENDING) || texture_ != NO_INDEX) alpha = sampleTexture(texture_, point).a;
    if (feature(FEATURE_VERTEX_COLORS)) alpha *= vertexColor(point).a;
    return blends(material) ? given * alpha : alpha >= given ? 1.0 : 0.0;
}

/// Random bits of a segment, of this iteration alone.
uvec4 segmentBits(real3 origin, real3 direction) {
    uvec2 key = iterationKey();
    uvec4 start = pcg4d(uvec4(floatBitsToUint(vec3(origin)), key.x));
    return pcg4d(start ^ uvec4(floatBitsToUint(vec3(direction)), key.y));
}

/// Whether the segment meets what has this coverage; `surface` numbers primitives, and both sides of a sphere.
bool meetsCovered(uvec4 segment, uint surface, real coverage) {
    if (!feature(FEATURE_BLENDING)) return coverage > 0.0;
    return real(pcg4d(segment ^ surface).x >> 8) * 5.9604644775390625e-8 < coverage;
}
#endif
