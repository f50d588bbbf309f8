#include "scene/texture_table.h"

#include "scene/image_decode.h"

namespace antipode {
namespace {

/// 8×8 squares of magenta and black, which nobody takes for a picture.
Texture checker(const std::string& name) {
    constexpr uint32_t side = 8;
    Texture texture;
    texture.name = name;
    texture.width = texture.height = side;
    for (uint32_t i = 0; i < side * side; ++i) {
        const uint8_t value = (i / side + i) % 2 ? 0 : 255;
        texture.rgba.insert(texture.rgba.end(), {value, 0, value, 255});
    }
    return texture;
}

}  // namespace

TextureIndex TextureTable::add(Texture texture, const TextureSampling& sampling) {
    texture.srgb = sampling.use == TextureUse::Color;
    texture.wrapU = sampling.wrapU;
    texture.wrapV = sampling.wrapV;
    texture.nearest = sampling.nearest;
    texture.uvSet = sampling.uvSet;
    scene_.textures.push_back(std::move(texture));
    return uint32_t(scene_.textures.size() - 1);
}

void TextureTable::complain(const std::string& key, const Error& why, const char* consequence) {
    if (why.code() != ErrorCode::Input || strict_) throw Error(why.code(), "texture '" + key + "': " + why.what());
    if (complainedOf_.insert(key).second)
        scene_.notices.push_back("Texture '" + key + "': " + why.what() + "; " + consequence + ".");
}

TextureIndex TextureTable::find(const std::string& key, const TextureSampling& sampling,
                                const std::function<Texture()>& decode) {
    const auto [entry, isNew] = known_.try_emplace({key, sampling});
    if (!isNew) return entry->second;
    try {
        entry->second = add(decode(), sampling);
    } catch (const Error& e) {
        const bool isColor = sampling.use == TextureUse::Color;
        complain(key, e, isColor ? "a magenta checker stands in for it" : "it was left out");
        if (isColor) entry->second = add(checker(key), sampling);
    }
    return entry->second;
}

TextureIndex TextureTable::findFile(const std::string& name, const TextureSampling& sampling) {
    return find(name, sampling, [&] { return read(name, sampling.use); });
}

Texture TextureTable::read(const std::string& name, TextureUse use) {
    const std::string path = findImageFile(directory_, name);
    if (path.empty()) throw Error(ErrorCode::Input, "there is no such file, nor one of its name beside the model");
    return readTexture(path, use == TextureUse::Color, scene_.notices);
}

std::optional<Texture> TextureTable::tryToRead(const std::string& name, TextureUse use) {
    try {
        return read(name, use);
    } catch (const Error& e) {
        complain(name, e, "it was left out");
        return {};
    }
}

}  // namespace antipode
