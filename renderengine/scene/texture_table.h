// The textures that an imported file uses, each decoded once.
#pragma once

#include <assimp/material.h>
#include <assimp/scene.h>

#include <map>
#include <string>
#include <tuple>

#include "renderengine/scene.h"

namespace antipode {

/// What the values of a texture stand for, which decides how they are stored.
enum class TextureUse { Color, Data };

/// Finds, decodes and remembers textures. Neither the file nor the scene may go away while it lives.
class TextureTable {
public:
    /// `directory`: where relative file names start. `scene` receives textures and notices.
    TextureTable(const aiScene& file, std::string directory, Scene& scene);

    /// The texture of one kind and slot of an Assimp material, or nothing where the material has none.
    /// Throws Error(Input) where its image is missing or broken.
    TextureIndex find(const aiMaterial& material, aiTextureType type, unsigned slot, TextureUse use);

private:
    Texture load(const std::string& path) const;

    const aiScene& file_;
    std::string directory_;
    Scene& scene_;
    std::map<std::tuple<std::string, TextureUse, WrapMode, WrapMode>, uint32_t> known_;
};

}  // namespace antipode
