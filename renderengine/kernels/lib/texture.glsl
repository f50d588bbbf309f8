// Texture look-ups from one buffer of linear half-float texels: needs no descriptor indexing.
#ifndef ANTIPODE_TEXTURE
#define ANTIPODE_TEXTURE
#include "lib/scene_data.glsl"

layout(set = 0, binding = BIND_TEXTURE_INFO) uniform usamplerBuffer textureInfo;
layout(set = 0, binding = BIND_TEXELS) uniform samplerBuffer texels;

const uint WRAP_REPEAT = 0, WRAP_MIRROR = 1, WRAP_CLAMP = 2;

int wrapTexel(int i, int size, uint mode) {
    if (mode == WRAP_CLAMP) return clamp(i, 0, size - 1);
    int period = mode == WRAP_MIRROR ? 2 * size : size;
    i = i % period;
    i = i < 0 ? i + period : i;
    return i < size ? i : period - 1 - i;
}

/// A point of a surface, as textures know it.
struct TexturePoint {
    real2 uv;  // of set 0
    uint primitive;
    real b1, b2;  // barycentrics
};

/// Where the parts of a primitive's record of BIND_MORE_ATTRIBUTES begin.
int moreAttributesOf(uint primitive) { return int(primitive * job.environmentSize.w); }
int vertexColorsOf(uint primitive) { return moreAttributesOf(primitive) + (feature(FEATURE_TANGENTS) ? 3 : 0); }
int furtherUvsOf(uint primitive, uint set) {
    return vertexColorsOf(primitive) + (feature(FEATURE_VERTEX_COLORS) ? 3 : 0) + 2 * int(set - 1u);
}

/// A triangle's texture coordinates of the set that the texture is looked up with.
void textureTriangle(uint index, uint primitive, inout real2 uv0, inout real2 uv1, inout real2 uv2) {
    if (!feature(FEATURE_MORE_UVS)) return;
    uint set = texelFetch(textureInfo, int(index)).w >> TEXTURE_UV_SET_SHIFT;
    if (set == 0u) return;
    int at = furtherUvsOf(primitive, set);
    uvec4 a = texelFetch(moreAttributes, at), b = texelFetch(moreAttributes, at + 1);
    uv0 = uintBitsToFloat(a.xy);
    uv1 = uintBitsToFloat(a.zw);
    uv2 = uintBitsToFloat(b.xy);
}

/// The interpolated colour of the vertices.
real4 vertexColor(TexturePoint at) {
    int i = vertexColorsOf(at.primitive);
    return (1.0 - at.b1 - at.b2) * uintBitsToFloat(texelFetch(moreAttributes, i)) +
           at.b1 * uintBitsToFloat(texelFetch(moreAttributes, i + 1)) +
           at.b2 * uintBitsToFloat(texelFetch(moreAttributes, i + 2));
}

/// Linear RGBA, texel centres at half-integers.
real4 sampleTexture(uint index, TexturePoint point) {
    uvec4 info = texelFetch(textureInfo, int(index));
    int width = int(info.y), height = int(info.z);
    uint wrapU = info.w & TEXTURE_WRAP_MASK, wrapV = (info.w >> TEXTURE_WRAP_V_SHIFT) & TEXTURE_WRAP_MASK;
    real2 uv = point.uv;
    if (feature(FEATURE_MORE_UVS)) {
        real2 uv0 = uv, uv1 = uv, uv2 = uv;
        textureTriangle(index, point.primitive, uv0, uv1, uv2);
        uv = (1.0 - point.b1 - point.b2) * uv0 + point.b1 * uv1 + point.b2 * uv2;
    }
    if (feature(FEATURE_NEAREST) && (info.w & TEXTURE_NEAREST) != 0u) {
        real2 texel = floor(uv * real2(width, height));
        return texelFetch(texels, int(info.x) + wrapTexel(int(texel.y), height, wrapV) * width +
                                      wrapTexel(int(texel.x), width, wrapU));
    }
    real2 at = uv * real2(width, height) - 0.5;
    real2 base = floor(at);
    real2 f = at - base;
    int x0 = wrapTexel(int(base.x), width, wrapU), x1 = wrapTexel(int(base.x) + 1, width, wrapU);
    int y0 = wrapTexel(int(base.y), height, wrapV), y1 = wrapTexel(int(base.y) + 1, height, wrapV);
    int offset = int(info.x);
    real4 top = mix(texelFetch(texels, offset + y0 * width + x0), texelFetch(texels, offset + y0 * width + x1), f.x);
    real4 bottom = mix(texelFetch(texels, offset + y1 * width + x0), texelFetch(texels, offset + y1 * width + x1), f.x);
    return mix(top, bottom, f.y);
}
#endif
