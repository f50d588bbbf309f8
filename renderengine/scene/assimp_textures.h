// Textures as Assimp hands them over.
#pragma once

#include <assimp/material.h>
#include <assimp/scene.h>

#include "scene/texture_table.h"

namespace antipode {

/// The texture of one kind and slot of a material, or nothing where it has none. Images that the file embeds are
/// decoded from it.
TextureIndex findTexture(const aiScene& file, const aiMaterial& material, aiTextureType type, unsigned slot,
                         TextureUse use, TextureTable& textures);

/// The greatest index of a set of texture coordinates that a texture of the material asks for.
unsigned lastUvSetOf(const aiMaterial& material);

}  // namespace antipode
