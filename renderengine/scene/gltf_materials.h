// Materials of glTF 2.0: factors and extensions from the JSON, images through Assimp.
#pragma once

#include <assimp/material.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "scene/assimp_textures.h"

namespace antipode {

/// glTF's metallic-roughness model with KHR_materials_emissive_strength, _ior, _specular and _transmission:
///  - transmissionFactor ≥ ½ → Dielectric where roughness is 0, RoughDielectric otherwise;
///  - metallicFactor 0 and specularFactor 0 → Lambert;
///  - anything else → MetallicRoughness;
///  - KHR_materials_unlit → emits the base colour and reflects nothing.
/// All reflect on both sides; both emit where the material is doubleSided.
/// `json` is null for Assimp's default material (glTF's default: white, metallic, rough). What cannot be represented is
/// said in `notices`. Throws nlohmann::json::exception where a value has the wrong type, Error(Input) for images.
Material importGltfMaterial(const nlohmann::json* json, const std::string& name, const aiScene& file,
                            const aiMaterial& assimp, TextureTable& textures, std::vector<std::string>& notices);

}  // namespace antipode
