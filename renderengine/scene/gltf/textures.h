// Textures of a glTF file's materials: texture, sampler and image.
#pragma once

#include "scene/gltf/document.h"
#include "scene/texture_table.h"

namespace antipode::gltf {

class Textures {
public:
    /// Neither the document nor the table nor the scene of the notices may go away while it lives.
    Textures(const Document& document, TextureTable& table, std::vector<std::string>& notices)
        : document_(document), table_(table), notices_(notices) {}

    /// What a textureInfo of a material ("baseColorTexture", …) refers to; nothing where it is empty. Throws
    /// Error(Input) where it refers to what does not exist.
    TextureIndex find(const json& textureInfo, TextureUse use);

private:
    const Document& document_;
    TextureTable& table_;
    std::vector<std::string>& notices_;
};

}  // namespace antipode::gltf
