#include "scene/gltf/textures.h"

#include <algorithm>
#include <cmath>

#include "renderengine/error.h"
#include "scene/gltf/container.h"
#include "scene/image_decode.h"

namespace antipode::gltf {
namespace {

enum Wrap { kClampToEdge = 33071, kMirroredRepeat = 33648 };
constexpr uint64_t kNearest = 9728;

WrapMode toWrapMode(uint64_t wrap) {
    return wrap == kClampToEdge ? WrapMode::Clamp : wrap == kMirroredRepeat ? WrapMode::Mirror : WrapMode::Repeat;
}

std::array<double, 2> pair(const json& parent, const char* key, std::array<double, 2> otherwise) {
    const json& from = list(parent, key);
    return from.empty() ? otherwise : std::array{from.at(0).get<double>(), from.at(1).get<double>()};
}

}  // namespace

std::array<float, 2> UvStream::operator()(const std::array<float, 2>& uv) const {
    if (*this == UvStream{texCoord}) return uv;
    // Counter-clockwise as people see it, with v growing downwards: what the extension's example of a quarter turn and
    // Khronos' TextureTransformTest ask for, and against the matrix in its text (KhronosGroup/glTF issue 1563).
    const double c = std::cos(rotation), s = std::sin(rotation), u = uv[0] * scale[0], v = uv[1] * scale[1];
    return {float(c * u + s * v + offset[0]), float(c * v - s * u + offset[1])};
}

uint32_t Textures::uvSetFor(const json& textureInfo) {
    const json& transform = extension(textureInfo, "KHR_texture_transform");
    const UvStream stream{natural(transform, "texCoord", natural(textureInfo, "texCoord", 0)),
                          pair(transform, "offset", {0, 0}), pair(transform, "scale", {1, 1}),
                          transform.value("rotation", 0.0)};
    const auto known = std::find(uvStreams_.begin(), uvStreams_.end(), stream);
    const auto index = uint32_t(known - uvStreams_.begin());
    if (known == uvStreams_.end()) uvStreams_.push_back(stream);
    return index;
}

TextureIndex Textures::find(const json& textureInfo, TextureUse use) {
    const auto index = reference(textureInfo, "index");
    if (!index) return {};
    const json& texture = entry(document_.json, "textures", *index);
    TextureSampling sampling{use};
    if (const auto at = reference(texture, "sampler")) {
        const json& sampler = entry(document_.json, "samplers", *at);
        sampling.wrapU = toWrapMode(natural(sampler, "wrapS", 0));
        sampling.wrapV = toWrapMode(natural(sampler, "wrapT", 0));
        sampling.nearest = natural(sampler, "magFilter", 0) == kNearest;
    }
    sampling.uvSet = uvSetFor(textureInfo);
    auto source = reference(texture, "source");
    if (const auto webp = reference(extension(texture, "EXT_texture_webp"), "source")) source = webp;
    if (!source) {
        // As where KTX2 pictures stand alone (KHR_texture_basisu).
        const std::string name = nameOf(texture, "texture", *index);
        return table_.find(name, sampling, []() -> Texture {
            throw Error(ErrorCode::Input, "it has no picture of a kind that is read");
        });
    }
    const json& image = entry(document_.json, "images", *source);
    const std::string uri = image.value("uri", "");
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
