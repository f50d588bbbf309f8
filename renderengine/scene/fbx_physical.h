// Physically based materials of 3ds Max and Maya, which FBX keeps beside the classic numbers.
#pragma once

#include <assimp/material.h>

#include "renderengine/scene.h"
#include "scene/texture_table.h"

namespace antipode {

/// Reads Max's Physical, PBR (metal/rough), OpenPBR and glTF materials and Maya's Standard Surface, aiStandardSurface
/// and Stingray PBS into MaterialKind::MetallicRoughness: base colour, roughness, metalness, clear coat, transmission
/// and index of refraction, with maps of roughness and metalness that lie beside the file. What else they say
/// (subsurface, fuzz, thin films, anisotropy) is not read. False, and `m` as it was, where the material is none of
/// these.
bool readFbxPhysical(const aiMaterial& material, TextureTable& textures, Material& m);

}  // namespace antipode
