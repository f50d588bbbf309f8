#include "scene/import_materials.h"

#include <assimp/ObjMaterial.h>
#include <assimp/material.h>

#include "scene/gltf_materials.h"

namespace antipode {
namespace {

/// illum of Wavefront MTL; files of other formats have none.
enum Illumination { kColorOnly = 0, kDiffuse = 1, kHighlight = 2, kReflection = 3, kGlass = 4, kRefractionFresnel = 7 };

Vec3f readColor(const aiMaterial& material, const char* key, unsigned type, unsigned index, Vec3f otherwise) {
    aiColor3D c;
    return material.Get(key, type, index, c) == aiReturn_SUCCESS ? Vec3f(c.r, c.g, c.b) : otherwise;
}

float readFloat(const aiMaterial& material, const char* key, unsigned type, unsigned index, float otherwise) {
    ai_real value = otherwise;
    return material.Get(key, type, index, value) == aiReturn_SUCCESS ? float(value) : otherwise;
}

bool isBlack(const Vec3f& c) { return c == Vec3f{}; }

void makeDielectric(Material& m, float ior, std::vector<std::string>& notices) {
    m.kind = MaterialKind::Dielectric;
    m.baseColor = Vec3f(1.0f);
    m.baseColorTexture.reset();
    m.ior = ior;
    if (ior <= 1) {
        m.ior = 1.5f;
        notices.push_back("Material '" + m.name +
                          "' is transparent without an index of refraction above 1; it has 1.5.");
    }
}

void makePhong(Material& m, const Vec3f& specular, float exponent, std::vector<std::string>& notices) {
    m.kind = MaterialKind::Phong;
    m.specular = specular;
    m.phongExponent = exponent;
    const float total = maxComponent(m.baseColor + specular);
    if (total > 1) {
        m.baseColor = m.baseColor / total;
        m.specular = specular / total;
        notices.push_back("Material '" + m.name +
                          "' reflects more light than it receives (Kd + Ks > 1); both were scaled.");
    }
}

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
    // MTL's map_Ke stands without a factor as often as with one.
    if (m.emissionTexture && isBlack(m.emission)) m.emission = Vec3f(1.0f);

    const Vec3f specular = readColor(material, AI_MATKEY_COLOR_SPECULAR, Vec3f(0.0f));
    const float exponent = readFloat(material, AI_MATKEY_SHININESS, 0.0f);
    const float ior = readFloat(material, AI_MATKEY_REFRACTI, 1.0f);
    const float opacity = readFloat(material, AI_MATKEY_OPACITY, 1.0f);
    int illum = kHighlight;
    material.Get(AI_MATKEY_OBJ_ILLUM, illum);

    if ((illum >= kGlass && illum <= kRefractionFresnel) || (opacity < 1 && ior > 1)) {
        makeDielectric(m, ior, notices);
    } else if (illum == kReflection && isBlack(m.baseColor)) {
        m.kind = MaterialKind::Mirror;
        m.specular = specular;
    } else if (!isBlack(specular) && illum != kColorOnly && illum != kDiffuse) {
        makePhong(m, specular, exponent, notices);
    }
    if (opacity < 1 && m.kind != MaterialKind::Dielectric)
        notices.push_back("Material '" + m.name + "' is partly transparent without refracting; it is opaque here.");
    return m;
}

std::vector<std::optional<Material>> importMaterials(const aiScene& file, const GltfDocument* gltf,
                                                     const std::string& directory, bool strict, Scene& scene) {
    TextureTable textures(directory, strict, scene);
    std::vector<std::optional<Material>> materials(file.mNumMaterials);
    for (unsigned i = 0; i < file.mNumMeshes; ++i) {
        const unsigned index = file.mMeshes[i]->mMaterialIndex;
        if (materials[index]) continue;
        const aiMaterial& material = *file.mMaterials[index];
        if (!gltf) {
            materials[index] = importClassicMaterial(file, material, textures, scene.notices);
            continue;
        }
        const auto entry = gltf->find("materials", const_cast<aiMaterial&>(material).GetName().C_Str());
        materials[index] = importGltfMaterial(entry ? &gltf->json["materials"][*entry] : nullptr,
                                              entry ? gltf->materialNames[*entry] : "default", file, material, textures,
                                              scene.notices);
    }
    return materials;
}

}  // namespace antipode
