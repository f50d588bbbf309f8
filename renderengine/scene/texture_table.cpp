#include "scene/texture_table.h"

#include <algorithm>
#include <filesystem>

#include "renderengine/error.h"
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

}  // namespace

TextureTable::TextureTable(const aiScene& file, std::string directory, Scene& scene)
    : file_(file), directory_(std::move(directory)), scene_(scene) {}

TextureIndex TextureTable::find(const aiMaterial& material, aiTextureType type, unsigned slot, TextureUse use) {
    aiString path;
    aiTextureMapMode wrap[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned uvSet = 0;
    if (material.GetTexture(type, slot, &path, nullptr, &uvSet, nullptr, nullptr, wrap) != aiReturn_SUCCESS) return {};
    if (path.length == 0) return {};
    if (uvSet != 0) {
        scene_.notices.push_back("Texture '" + std::string(path.C_Str()) +
                                 "' asks for a second set of texture coordinates; the first is used.");
    }
    const auto key = std::make_tuple(std::string(path.C_Str()), use, toWrapMode(wrap[0]), toWrapMode(wrap[1]));
    if (const auto found = known_.find(key); found != known_.end()) return found->second;

    Texture texture = load(path.C_Str());
    texture.srgb = use == TextureUse::Color;
    texture.wrapU = std::get<2>(key);
    texture.wrapV = std::get<3>(key);
    const auto index = uint32_t(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
    known_.emplace(key, index);
    return index;
}

Texture TextureTable::load(const std::string& path) const {
    if (const aiTexture* embedded = file_.GetEmbeddedTexture(path.c_str())) {
        const std::string name = embedded->mFilename.length > 0 ? embedded->mFilename.C_Str() : path;
        if (embedded->mHeight != 0) return fromTexels(*embedded, name);
        return decodeImage({reinterpret_cast<const uint8_t*>(embedded->pcData), embedded->mWidth}, name);
    }
    // Files written under Windows separate folders by backslashes.
    std::string portable = path;
    std::replace(portable.begin(), portable.end(), '\\', '/');
    return readTexture((std::filesystem::path(directory_) / portable).string());
}

}  // namespace antipode
