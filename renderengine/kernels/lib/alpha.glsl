// Holes cut by the alpha of a base colour texture, decided while a ray is traced.
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

bool alphaCovers(uint material, uint primitive, real b1, real b2) {
    uint at = material * MATERIAL_TEXELS;
    uint kind = texelFetch(materials, int(at)).w;
    if ((kind & MATERIAL_ALPHA) == 0u) return true;
    uint texture_ = texelFetch(materials, int(at + 4u)).x;
    real cutoff = uintBitsToFloat(texelFetch(materials, int(at + 3u)).z);
    return sampleTexture(texture_, triangleUv(primitive, b1, b2)).a >= cutoff;
}
#endif
