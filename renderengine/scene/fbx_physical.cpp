#include "scene/fbx_physical.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>

#include "scene/mtl_textures.h"

namespace antipode {
namespace {

/// What the materials call the same thing; the first that is there counts.
using Names = std::initializer_list<const char*>;

std::optional<Vec3f> color(const aiMaterial& material, Names names) {
    for (const char* name : names) {
        std::array<ai_real, 4> value{};
        unsigned count = unsigned(value.size());
        const std::string key = std::string("$raw.") + name;
        if (aiGetMaterialFloatArray(&material, key.c_str(), 0, 0, value.data(), &count) == aiReturn_SUCCESS &&
            count >= 3)
            return Vec3f(value[0], value[1], value[2]);
    }
    return {};
}

std::optional<float> number(const aiMaterial& material, Names names) {
    for (const char* name : names) {
        ai_real value = 0;
        if (material.Get((std::string("$raw.") + name).c_str(), 0, 0, value) == aiReturn_SUCCESS) return float(value);
    }
    return {};
}

float share(std::optional<float> value, float otherwise) { return std::clamp(value.value_or(otherwise), 0.0f, 1.0f); }

/// A map in a file of its own, white where the material has none.
MtlMap map(const aiMaterial& material, aiTextureType type) {
    MtlMap found;
    aiString path;
    if (material.GetTexture(type, 0, &path) == aiReturn_SUCCESS && path.length > 0 && path.C_Str()[0] != '*')
        found.file = path.C_Str();
    return found;
}

}  // namespace

bool readFbxPhysical(const aiMaterial& material, TextureTable& textures, Material& m) {
    const auto roughness =
        number(material, {"3dsMax|main|roughness", "3dsMax|Parameters|specular_roughness",
                          "3dsMax|Parameters|roughness", "Maya|specularRoughness", "Maya|roughness"});
    if (!roughness) return false;
    m.kind = MaterialKind::MetallicRoughness;
    m.roughness = share(roughness, 1);
    const bool isGloss = number(material, {"3dsMax|Parameters|roughness_inv"}).value_or(0) > 0;
    if (isGloss) m.roughness = 1 - m.roughness;
    m.metallic = share(number(material, {"3dsMax|main|metalness", "3dsMax|Parameters|base_metalness",
                                         "3dsMax|Parameters|metalness", "Maya|metalness", "Maya|metallic"}),
                       0);
    if (!m.baseColorTexture) {
        const auto base = color(material, {"3dsMax|main|baseColor", "3dsMax|main|basecolor",
                                           "3dsMax|Parameters|base_color", "Maya|baseColor", "Maya|base_color"});
        const float weight = share(number(material, {"3dsMax|Parameters|base_weight", "Maya|base"}), 1);
        if (base)
            for (int c = 0; c < 3; ++c) m.baseColor[c] = std::clamp((*base)[c] * weight, 0.0f, 1.0f);
    }
    m.clearcoat = share(number(material, {"3dsMax|Parameters|coat_weight", "3dsMax|Parameters|coating",
                                          "3dsMax|extension|clearcoat", "Maya|coat"}),
                        0);
    m.clearcoatRoughness = share(number(material, {"3dsMax|Parameters|coat_roughness",
                                                   "3dsMax|extension|clearcoatRoughness", "Maya|coatRoughness"}),
                                 0);
    m.transmission = share(number(material, {"3dsMax|Parameters|transmission_weight", "3dsMax|Parameters|transparency",
                                             "3dsMax|extension|transmission", "Maya|transmission"}),
                           0);
    const auto ior = number(material, {"3dsMax|Parameters|specular_ior", "3dsMax|Parameters|trans_ior",
                                       "3dsMax|extension|indexOfRefraction", "Maya|specularIOR"});
    if (ior && *ior >= 1) m.ior = *ior;

    const MtlMap rough = isGloss ? MtlMap{} : map(material, aiTextureType_DIFFUSE_ROUGHNESS);
    const MtlMap metal = map(material, aiTextureType_METALNESS);
    if (!rough && !metal) return true;
    m.metallicRoughnessTexture = metallicRoughnessMap(rough, metal, textures);
    if (m.metallicRoughnessTexture) {
        if (rough) m.roughness = 1;
        if (metal) m.metallic = 1;
    }
    return true;
}

}  // namespace antipode
