// Bilinear texture look-ups from one buffer of linear half-float texels: needs no descriptor indexing.
#ifndef ANTIPODE_TEXTURE
#define ANTIPODE_TEXTURE

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

/// Linear RGBA at uv, texel centres at half-integers.
real4 sampleTexture(uint index, real2 uv) {
    uvec4 info = texelFetch(textureInfo, int(index));
    int width = int(info.y), height = int(info.z);
    uint wrapU = info.w & 0xFFu, wrapV = info.w >> 8;
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
