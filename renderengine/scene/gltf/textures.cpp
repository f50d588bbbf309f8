#include "scene/gltf/textures.h"

#include "renderengine/error.h"
#include "scene/gltf/container.h"
#include "scene/image_decode.h"

namespace antipode::gltf {
namespace {

enum Wrap { kClampToEdge = 33071, kMirroredRepeat = 33648 };

WrapMode toWrapMode(uint64_t wrap) {
    return wrap == kClampToEdge ? WrapMode::Clamp : wrap == kMirroredRepeat ? WrapMode::Mirror : WrapMode::Repeat;
}

}  // namespace

TextureIndex Textures::find(const json& textureInfo, TextureUse use) {
    const auto index = reference(textureInfo, "index");
    if (!index) return {};
    const json& texture = entry(document_.json, "textures", *index);
    TextureSampling sampling{use};
    if (const auto at = reference(texture, "sampler")) {
        const json& sampler = entry(document_.json, "samplers", *at);
        sampling.wrapU = toWrapMode(natural(sampler, "wrapS", 0));
        sampling.wrapV = toWrapMode(natural(sampler, "wrapT", 0));
    }
    const auto source = reference(texture, "source");
    if (!source) {
        const std::string name = nameOf(texture, "texture", *index);
        return table_.find(name, sampling,
                           []() -> Texture { throw Error(ErrorCode::Input, "it names no image that is read"); });
    }
    const json& image = entry(document_.json, "images", *source);
    const std::string uri = image.value("uri", "");
    if (natural(textureInfo, "texCoord", 0) != 0)
        notices_.push_back("Texture '" + nameOf(image, "image", *source) +
                           "' asks for a second set of texture coordinates; the first is used.");
    if (!uri.empty() && !uri.starts_with("data:")) return table_.findFile(decodeUri(uri), sampling);
    // Names of images need not differ.
    const std::string name = image.value("name", "");
    const std::string key = "image " + std::to_string(*source) + (name.empty() ? "" : " (" + name + ")");
    return table_.find(key, sampling, [&] {
        if (!uri.empty()) return decodeImage(decodeDataUri(uri), key);
        return decodeImage(document_.buffers.view(natural(image.at("bufferView"))).bytes, key);
    });
}

}  // namespace antipode::gltf
