// Textures of a glTF file's materials: texture, sampler and image.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/texture_table.h"

namespace antipode::gltf {

/// Texture coordinates as a texture wants them: a set of the file's, transformed (KHR_texture_transform).
struct UvStream {
    uint64_t texCoord = 0;
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotation = 0;  ///< radians

    bool operator==(const UvStream&) const = default;
    std::array<float, 2> operator()(const std::array<float, 2>& uv) const;
};

class Textures {
public:
    /// Neither the document nor the table may go away while it lives.
    Textures(const Document& document, TextureTable& table) : document_(document), table_(table) {}

    /// The texture coordinates that what was found since the last call is looked up with: entry k as set k.
    std::vector<UvStream> takeUvStreams() { return std::exchange(uvStreams_, {}); }

    /// What a textureInfo of a material ("baseColorTexture", …) refers to; nothing where it is empty. Throws
    /// Error(Input) where it refers to what does not exist.
    TextureIndex find(const json& textureInfo, TextureUse use);

private:
    uint32_t uvSetFor(const json& textureInfo);

    const Document& document_;
    TextureTable& table_;
    std::vector<UvStream> uvStreams_;
};

}  // namespace antipode::gltf
