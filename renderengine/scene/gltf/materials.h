// Materials of glTF 2.0.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "scene/gltf/textures.h"

namespace antipode::gltf {

/// glTF's metallic-roughness model with KHR_materials_clearcoat, _dispersion, _emissive_strength, _ior, _sheen,
/// _specular, _transmission and _volume:
///  - clear glass, white and all of it → Dielectric where roughness is 0, RoughDielectric otherwise; glass without a
///    thickness is thin;
///  - metallicFactor 0, specularFactor 0 and no layer → Lambert;
///  - anything else → MetallicRoughness;
///  - KHR_materials_pbrSpecularGlossiness → a dielectric of that reflectance;
///  - KHR_materials_unlit → emits the base colour and reflects nothing.
/// All reflect on both sides; both emit where the material is doubleSided.
/// `json` is null for the format's default material (white, metallic, rough). What cannot be represented is
/// said in `notices`. Throws nlohmann::json::exception where a value has the wrong type, Error(Input) for images.
Material readMaterial(const nlohmann::json* json, const std::string& name, Textures& textures,
                      std::vector<std::string>& notices);

}  // namespace antipode::gltf
