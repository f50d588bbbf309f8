#include "scene/import_materials.h"

#include <assimp/commonMetaData.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "scene/classic_lobes.h"
#include "scene/fbx_physical.h"
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

std::string nameOf(const aiMaterial& material) { return const_cast<aiMaterial&>(material).GetName().C_Str(); }

bool isBlack(const Vec3f& c) { return c == Vec3f{}; }

/// What a classic material says, or would if its file were right.
struct Surface {
    Vec3f diffuse, specular;
    float exponent, ior, opacity;
};

Surface readSurface(const MaterialSource& source, const aiMaterial& material) {
    Surface s;
    s.diffuse = readColor(material, AI_MATKEY_COLOR_DIFFUSE, Vec3f(kDefaultGrey));
    s.specular = readColor(material, AI_MATKEY_COLOR_SPECULAR, Vec3f(0.0f));
    s.exponent = std::max(0.0f, readFloat(material, AI_MATKEY_SHININESS, 0.0f));
    s.ior = readFloat(material, AI_MATKEY_REFRACTI, 1.0f);
    s.opacity = readFloat(material, AI_MATKEY_OPACITY, 1.0f);
    switch (source.format) {
        case ModelFormat::Stl:
        case ModelFormat::Ply: {
            // Assimp's own: white or light grey, with a highlight.
            const bool invented = s.diffuse == s.specular;
            s.specular = Vec3f{};
            if (invented) s.diffuse = Vec3f(kDefaultGrey);
            break;
        }
        case ModelFormat::Collada:
            if (const auto highlight = source.collada->highlight(nameOf(material))) {
                s.specular = highlight->specular;
                s.exponent = highlight->exponent;
            }
            break;
        case ModelFormat::Fbx: s.specular = s.specular * readFloat(material, AI_MATKEY_SHININESS_STRENGTH, 1.0f); break;
        default: break;
    }
    return s;
}

bool isWrittenByBlender(const aiScene& file) {
    aiString generator;
    return file.mMetaData && file.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, generator) &&
           std::string_view(generator.C_Str()).starts_with("Blender");
}

/// Undoes what Blender's exporter does to a principled material (io_scene_fbx, fbx_data_material_elements): Shininess =
/// (10·(1 − roughness))², SpecularFactor = specular / 2, ReflectionFactor = metallic. Its specular ½ is glTF's 1.
void makePrincipled(Material& m, const aiMaterial& material) {
    const float shininess = readFloat(material, AI_MATKEY_SHININESS, 0.0f);
    m.roughness = std::clamp(1 - std::sqrt(std::max(0.0f, shininess)) / 10, 0.0f, 1.0f);
    m.metallic = std::clamp(readFloat(material, AI_MATKEY_REFLECTIVITY, 0.0f), 0.0f, 1.0f);
    m.specularFactor = std::clamp(4 * readFloat(material, AI_MATKEY_SHININESS_STRENGTH, 0.0f), 0.0f, 1.0f);
    m.kind = m.metallic == 0 && m.specularFactor == 0 ? MaterialKind::Lambert : MaterialKind::MetallicRoughness;
}

void chooseClassicKind(Material& m, const Surface& surface, const MaterialSource& source, const aiMaterial& material,
                       std::vector<std::string>& notices) {
    if (surface.opacity < 0.5f && surface.ior > 1)
        makeDielectric(m, surface.ior, notices);
    else if (source.format == ModelFormat::Fbx && isWrittenByBlender(source.file))
        makePrincipled(m, material);
    else if (!isBlack(surface.specular))
        makePhong(m, surface.specular, surface.exponent, notices);
}

std::string textureFile(const aiMaterial& material, aiTextureType type) {
    aiString path;
    return material.GetTexture(type, 0, &path) == aiReturn_SUCCESS ? path.C_Str() : "";
}

/// What does not refract and lets light pass: a part of the surface is not there.
void setCoverage(Material& m, float opacity, const aiMaterial& material, std::vector<std::string>& notices) {
    if (m.transmits()) return;
    // Exporters disagree on which end of the scale is opaque, and nobody keeps what cannot be seen.
    if (opacity <= 0) {
        notices.push_back("Material '" + m.name + "' would be invisible by its transparency; it is opaque here.");
        opacity = 1;
    }
    const std::string colors = textureFile(material, aiTextureType_DIFFUSE);
    const bool byTexture = !colors.empty() && colors == textureFile(material, aiTextureType_OPACITY);
    if (opacity < 1 || byTexture) m.coverage = std::min(opacity, 1.0f);
}

bool isUsed(const Material& m, const aiMaterial& material, aiTextureType type) {
    switch (type) {
        case aiTextureType_OPACITY:
            return m.coverage && textureFile(material, type) == textureFile(material, aiTextureType_DIFFUSE);
        case aiTextureType_BASE_COLOR:
            return m.baseColorTexture && (textureFile(material, aiTextureType_DIFFUSE).empty() ||
                                          textureFile(material, aiTextureType_DIFFUSE) == textureFile(material, type));
        case aiTextureType_METALNESS:
        case aiTextureType_DIFFUSE_ROUGHNESS: return m.metallicRoughnessTexture.has_value();
        default: return false;
    }
}

void noticeUnusedTextures(const Material& m, const aiMaterial& material, std::vector<std::string>& notices) {
    constexpr std::pair<aiTextureType, const char*> unused[] = {
        {aiTextureType_SPECULAR, "specular"},      {aiTextureType_HEIGHT, "height"},
        {aiTextureType_SHININESS, "shininess"},    {aiTextureType_OPACITY, "opacity"},
        {aiTextureType_REFLECTION, "reflection"},  {aiTextureType_DISPLACEMENT, "displacement"},
        {aiTextureType_METALNESS, "metalness"},    {aiTextureType_DIFFUSE_ROUGHNESS, "roughness"},
        {aiTextureType_BASE_COLOR, "base colour"}, {aiTextureType_EMISSION_COLOR, "emission"},
    };
    for (const auto& [type, name] : unused) {
        aiString path;
        if (isUsed(m, material, type)) continue;
        if (material.GetTexture(type, 0, &path) == aiReturn_SUCCESS && path.length > 0)
            notices.push_back("Material '" + m.name + "': its " + name + " texture '" + path.C_Str() + "' is ignored.");
    }
}

}  // namespace

Material importClassicMaterial(const MaterialSource& source, const aiMaterial& material, TextureTable& textures,
                               std::vector<std::string>& notices) {
    const auto texture = [&](aiTextureType type, TextureUse use) {
        return findTexture(source.file, material, type, 0, use, textures);
    };
    const Surface surface = readSurface(source, material);
    Material m;
    m.name = nameOf(material);
    m.baseColor = surface.diffuse;
    m.emission = readColor(material, AI_MATKEY_COLOR_EMISSIVE, Vec3f(0.0f));
    m.baseColorTexture = texture(aiTextureType_DIFFUSE, TextureUse::Color);
    if (!m.baseColorTexture) m.baseColorTexture = texture(aiTextureType_BASE_COLOR, TextureUse::Color);
    m.emissionTexture = texture(aiTextureType_EMISSIVE, TextureUse::Color);
    m.normalTexture = texture(aiTextureType_NORMALS, TextureUse::Data);
    if (!m.normalTexture) m.normalTexture = texture(aiTextureType_NORMAL_CAMERA, TextureUse::Data);
    // A map of emission stands without a factor as often as with one.
    if (m.emissionTexture && isBlack(m.emission)) m.emission = Vec3f(1.0f);
    if (source.format == ModelFormat::Fbx && m.baseColorTexture) m.baseColor = Vec3f(1.0f);

    const bool isPhysical = source.format == ModelFormat::Fbx && readFbxPhysical(material, textures, m);
    if (!isPhysical) chooseClassicKind(m, surface, source, material, notices);
    setCoverage(m, surface.opacity, material, notices);
    noticeUnusedTextures(m, material, notices);
    return m;
}

std::vector<std::optional<Material>> importMaterials(const MaterialSource& source, const std::string& directory,
                                                     bool strict, Scene& scene) {
    TextureTable textures(directory, strict, scene);
    const aiScene& file = source.file;
    std::vector<std::optional<Material>> materials(file.mNumMaterials);
    for (unsigned i = 0; i < file.mNumMeshes; ++i) {
        const unsigned index = file.mMeshes[i]->mMaterialIndex;
        if (materials[index]) continue;
        materials[index] = importClassicMaterial(source, *file.mMaterials[index], textures, scene.notices);
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
        const std::string name = nameOf(*file.mMaterials[mesh.material]);
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
