#include "scene/assimp_textures.h"

#include <algorithm>

#include "scene/image_decode.h"

namespace antipode {
namespace {

WrapMode toWrapMode(aiTextureMapMode mode) {
    switch (mode) {
        case aiTextureMapMode_Mirror: return WrapMode::Mirror;
        case aiTextureMapMode_Clamp:
        case aiTextureMapMode_Decal: return WrapMode::Clamp;
        default: return WrapMode::Repeat;
    }
}

/// Uncompressed embedded pixels (aiTexel is BGRA in memory order).
Texture fromTexels(const aiTexture& embedded, const std::string& name) {
    Texture texture;
    texture.name = name;
    texture.width = embedded.mWidth;
    texture.height = embedded.mHeight;
    const size_t count = size_t(embedded.mWidth) * embedded.mHeight;
    texture.rgba.reserve(count * 4);
    for (size_t i = 0; i < count; ++i) {
        const aiTexel& t = embedded.pcData[i];
        texture.rgba.insert(texture.rgba.end(), {t.r, t.g, t.b, t.a});
    }
    return texture;
}

Texture decodeEmbedded(const aiTexture& embedded, const std::string& path) {
    const std::string name = embedded.mFilename.length > 0 ? embedded.mFilename.C_Str() : path;
    if (embedded.mHeight != 0) return fromTexels(embedded, name);
    return decodeImage({reinterpret_cast<const uint8_t*>(embedded.pcData), embedded.mWidth}, name);
}

}  // namespace

TextureIndex findTexture(const aiScene& file, const aiMaterial& material, aiTextureType type, unsigned slot,
                         TextureUse use, TextureTable& textures) {
    aiString path;
    aiTextureMapMode wrap[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned uvSet = 0;
    if (material.GetTexture(type, slot, &path, nullptr, &uvSet, nullptr, nullptr, wrap) != aiReturn_SUCCESS) return {};
    if (path.length == 0) return {};
    const std::string name = path.C_Str();
    const TextureSampling sampling{use, toWrapMode(wrap[0]), toWrapMode(wrap[1]), false,
                                   std::min(uvSet, AI_MAX_NUMBER_OF_TEXTURECOORDS - 1u)};
    if (const aiTexture* embedded = file.GetEmbeddedTexture(name.c_str()))
        return textures.find(name, sampling, [&] { return decodeEmbedded(*embedded, name); });
    return textures.findFile(name, sampling);
}

unsigned lastUvSetOf(const aiMaterial& material) {
    unsigned last = 0;
    for (int type = aiTextureType_NONE; type <= AI_TEXTURE_TYPE_MAX; ++type) {
        aiString path;
        unsigned uvSet = 0;
        if (material.GetTexture(aiTextureType(type), 0, &path, nullptr, &uvSet) == aiReturn_SUCCESS)
            last = std::max(last, std::min(uvSet, AI_MAX_NUMBER_OF_TEXTURECOORDS - 1u));
    }
    return last;
}

}  // namespace antipode
