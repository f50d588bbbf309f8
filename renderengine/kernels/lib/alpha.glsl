// Holes cut by the alpha of a base colour texture: asked while a ray is traced, and of points sampled on emitters.
#ifndef ANTIPODE_ALPHA
#define ANTIPODE_ALPHA
#include "lib/scene_data.glsl"
#include "lib/texture.glsl"

/// Texture coordinates of a triangle's point.
real2 triangleUv(uint primitive, real b1, real b2) {
    uvec4 a2 = texelFetch(attributes, int(4u * primitive + 2u)), a3 = texelFetch(attributes, int(4u * primitive + 3u));
    real2 uv0 = uintBitsToFloat(uvec2(a2.y, a2.z)), uv1 = uintBitsToFloat(uvec2(a2.w, a3.x)),
          uv2 = uintBitsToFloat(a3.yz);
    return (1.0 - b1 - b2) * uv0 + b1 * uv1 + b2 * uv2;
}

bool hasHoles(uint material) {
    return (texelFetch(materials, int(material * MATERIAL_TEXELS)).w & MATERIAL_ALPHA) != 0u;
}

/// Whether a material that has holes is there at uv.
bool alphaCovers(uint material, real2 uv) {
    uint at = material * MATERIAL_TEXELS;
    uint texture_ = texelFetch(materials, int(at + 4u)).x;
    real cutoff = uintBitsToFloat(texelFetch(materials, int(at + 3u)).z);
    return sampleTexture(texture_, uv).a >= cutoff;
}
#endif
