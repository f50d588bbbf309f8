#include "scene/import_materials.h"

#include <assimp/material.h>

#include <filesystem>

#include "scene/classic_lobes.h"
#include "scene/obj_materials.h"

namespace antipode {
namespace {

Vec3f readColor(const aiMaterial& material, const char* key, unsigned type, unsigned index, Vec3f otherwise) {
    aiColor3D c;
    return material.Get(key, type, index, c) == aiReturn_SUCCESS ? Vec3f(c.r, c.g, c.b) : otherwise;
}

float readFloat(const aiMaterial& material, const char* key, unsigned type, unsigned index, float otherwise) {
    ai_real value = otherwise;
    return material.Get(key, type, index, value) == aiReturn_SUCCESS ? float(value) : otherwise;
}

bool isBlack(const Vec3f& c) { return c == Vec3f{}; }

}  // namespace

Material importClassicMaterial(const aiScene& file, const aiMaterial& material, TextureTable& textures,
                               std::vector<std::string>& notices) {
    Material m;
    m.name = const_cast<aiMaterial&>(material).GetName().C_Str();
    m.baseColor = readColor(material, AI_MATKEY_COLOR_DIFFUSE, Vec3f(0.8f));
    m.emission = readColor(material, AI_MATKEY_COLOR_EMISSIVE, Vec3f(0.0f));
    const auto texture = [&](aiTextureType type, TextureUse use) {
        return findTexture(file, material, type, 0, use, textures, notices);
    };
    m.baseColorTexture = texture(aiTextureType_DIFFUSE, TextureUse::Color);
    m.emissionTexture = texture(aiTextureType_EMISSIVE, TextureUse::Color);
    m.normalTexture = texture(aiTextureType_NORMALS, TextureUse::Data);
    // A map of emission stands without a factor as often as with one.
    if (m.emissionTexture && isBlack(m.emission)) m.emission = Vec3f(1.0f);

    const Vec3f specular = readColor(material, AI_MATKEY_COLOR_SPECULAR, Vec3f(0.0f));
    const float exponent = readFloat(material, AI_MATKEY_SHININESS, 0.0f);
    const float ior = readFloat(material, AI_MATKEY_REFRACTI, 1.0f);
    const float opacity = readFloat(material, AI_MATKEY_OPACITY, 1.0f);

    if (opacity < 1 && ior > 1)
        makeDielectric(m, ior, notices);
    else if (!isBlack(specular))
        makePhong(m, specular, exponent, notices);
    if (opacity < 1 && m.kind != MaterialKind::Dielectric)
        notices.push_back("Material '" + m.name + "' is partly transparent without refracting; it is opaque here.");
    return m;
}

std::vector<std::optional<Material>> importMaterials(const aiScene& file, const std::string& directory, bool strict,
                                                     Scene& scene) {
    TextureTable textures(directory, strict, scene);
    std::vector<std::optional<Material>> materials(file.mNumMaterials);
    for (unsigned i = 0; i < file.mNumMeshes; ++i) {
        const unsigned index = file.mMeshes[i]->mMaterialIndex;
        if (materials[index]) continue;
        materials[index] = importClassicMaterial(file, *file.mMaterials[index], textures, scene.notices);
    }
    return materials;
}

std::vector<std::optional<Material>> importObjMaterials(const aiScene& file, const std::string& path, bool strict,
                                                        Scene& scene) {
    ObjLibraries libraries = readObjLibraries(path);
    for (std::string& notice : libraries.notices) scene.notices.push_back(std::move(notice));
    TextureTable textures(std::filesystem::path(path).parent_path().string(), strict, scene);
    std::vector<std::optional<Material>> materials(file.mNumMaterials);
    for (Mesh& mesh : scene.meshes) {
        const std::string name = const_cast<aiMaterial&>(*file.mMaterials[mesh.material]).GetName().C_Str();
        const auto entry = libraries.materials.find(name);
        const bool isKnown = entry != libraries.materials.end();
        if (std::optional<Material>& material = materials[mesh.material]; !material) {
            // Faces before any `usemtl` have Assimp's own material.
            if (!isKnown && name != AI_DEFAULT_MATERIAL_NAME)
                scene.notices.push_back("Material '" + name + "' is in no material library; a grey one stands for it.");
            material = importMtlMaterial(name, isKnown ? &entry->second : nullptr, textures, scene.notices);
        }
        if (isKnown) applyMapTransform(entry->second, mesh);
    }
    return materials;
}

}  // namespace antipode
