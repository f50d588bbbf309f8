#include "scene/gltf/materials.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf/json_access.h"

namespace antipode::gltf {
namespace {

Vec3f readColor(const json& parent, const char* key, Vec3f otherwise) {
    const auto found = parent.find(key);
    if (found == parent.end()) return otherwise;
    return {found->at(0).get<float>(), found->at(1).get<float>(), found->at(2).get<float>()};
}

bool hasLayers(const Material& m) { return m.clearcoat > 0 || maxComponent(m.sheenColor) > 0; }

/// KHR_materials_dispersion: 20 over the Abbe number.
void setDispersion(Material& m, const json& extensions, std::vector<std::string>& notices) {
    const float dispersion = object(extensions, "KHR_materials_dispersion").value("dispersion", 0.0f);
    if (dispersion <= 0) return;
    constexpr float greatest = 20;
    if (dispersion > greatest)
        notices.push_back("Material '" + m.name + "': its dispersion above 20 became 20, an Abbe number of 1.");
    m.abbeNumber = 20 / std::min(dispersion, greatest);
}

/// KHR_materials_transmission, _volume and _dispersion.
void setTransmission(Material& m, const json& extensions, TextureIndex transmissionTexture,
                     std::vector<std::string>& notices) {
    const bool metal = m.metallic == 1 && !m.metallicRoughnessTexture;
    const float transmission = object(extensions, "KHR_materials_transmission").value("transmissionFactor", 0.0f);
    if (transmission <= 0 || metal) return;
    m.transmission = transmission;
    m.transmissionTexture = transmissionTexture;
    const json& volume = object(extensions, "KHR_materials_volume");
    m.thin = volume.value("thicknessFactor", 0.0f) <= 0;
    const Vec3f left = readColor(volume, "attenuationColor", Vec3f(1.0f));
    if (volume.contains("attenuationDistance") && left != Vec3f(1.0f)) {
        m.attenuationColor = left;
        m.attenuationDistance = volume.value("attenuationDistance", 0.0f);
    }
    setDispersion(m, extensions, notices);
    if (m.specularFactor != 1 || m.specular != Vec3f(1.0f))
        notices.push_back(
            "Material '" + m.name +
            "': its glass reflects by its index of refraction alone, whatever KHR_materials_specular says.");
}

/// KHR_materials_clearcoat and _sheen, over what is not glass.
void setLayers(Material& m, const json& extensions, Textures& textures, std::vector<std::string>& notices) {
    const std::string material = "Material '" + m.name + "': ";
    const json& coat = object(extensions, "KHR_materials_clearcoat");
    m.clearcoat = coat.value("clearcoatFactor", 0.0f);
    if (m.clearcoat > 0) {
        m.clearcoatRoughness = coat.value("clearcoatRoughnessFactor", 0.0f);
        m.clearcoatTexture = textures.find(object(coat, "clearcoatTexture"), TextureUse::Data);
        m.clearcoatRoughnessTexture = textures.find(object(coat, "clearcoatRoughnessTexture"), TextureUse::Data);
        if (coat.contains("clearcoatNormalTexture"))
            notices.push_back(material + "the normal map of its clear coat is ignored.");
        if (m.normalTexture) notices.push_back(material + "its clear coat has the relief of what it covers.");
    }
    const json& sheen = object(extensions, "KHR_materials_sheen");
    m.sheenColor = readColor(sheen, "sheenColorFactor", Vec3f(0.0f));
    if (maxComponent(m.sheenColor) > 0) {
        m.sheenRoughness = sheen.value("sheenRoughnessFactor", 0.0f);
        m.sheenColorTexture = textures.find(object(sheen, "sheenColorTexture"), TextureUse::Color);
        m.sheenRoughnessTexture = textures.find(object(sheen, "sheenRoughnessTexture"), TextureUse::Data);
        if (m.sheenRoughness < 0.26f)
            notices.push_back(material + "the roughness of its sheen became .26, below which the model gains energy.");
    }
    if (m.transmission > 0 && hasLayers(m))
        notices.push_back(material + "clear coat and sheen cover what is not glass of it alone.");
}

/// KHR_materials_pbrSpecularGlossiness (archived): a dielectric whose index of refraction reflects the greatest channel
/// of the specular colour at normal incidence, over what is left of the diffuse colour.
void readSpecularGlossiness(Material& m, const json& from, Textures& textures, std::vector<std::string>& notices) {
    constexpr float greatestF0 = 0.98f;  // an index of 200; a perfect mirror has none
    const Vec3f specular = readColor(from, "specularFactor", Vec3f(1.0f));
    const float f0 = std::clamp(maxComponent(specular), 0.0f, greatestF0), root = std::sqrt(f0);
    m.metallic = 0;
    m.baseColor = readColor(from, "diffuseFactor", Vec3f(1.0f)) * (1 - f0);
    m.roughness = 1 - from.value("glossinessFactor", 1.0f);
    m.ior = (1 + root) / (1 - root);
    m.specular = f0 > 0 ? specular / maxComponent(specular) : Vec3f(0.0f);
    m.baseColorTexture = textures.find(object(from, "diffuseTexture"), TextureUse::Color);
    m.metallicRoughnessTexture.reset();
    if (from.contains("specularGlossinessTexture"))
        notices.push_back("Material '" + m.name + "': the texture of KHR_materials_pbrSpecularGlossiness is ignored.");
}

void setKind(Material& m) {
    const bool clear = m.transmission == 1 && !m.transmissionTexture && m.metallic == 0 &&
                       !m.metallicRoughnessTexture && m.baseColor == Vec3f(1.0f) && !m.baseColorTexture;
    if (clear)
        m.kind = m.roughness == 0 ? MaterialKind::Dielectric : MaterialKind::RoughDielectric;
    else if (m.metallic == 0 && m.specularFactor == 0 && m.transmission == 0 && !hasLayers(m))
        m.kind = MaterialKind::Lambert;
    else
        m.kind = MaterialKind::MetallicRoughness;
    if (m.kind != MaterialKind::MetallicRoughness) {
        m.metallicRoughnessTexture.reset();
        m.transmission = 0;
    }
}

void setAlpha(Material& m, const json& material, std::vector<std::string>& notices) {
    const std::string mode = material.value("alphaMode", "OPAQUE");
    if (mode == "OPAQUE") return;
    const json& extensions = object(material, "extensions");
    const json& archived = object(extensions, "KHR_materials_pbrSpecularGlossiness");
    const json& factor = !extensions.contains("KHR_materials_pbrSpecularGlossiness")
                             ? list(object(material, "pbrMetallicRoughness"), "baseColorFactor")
                             : list(archived, "diffuseFactor");
    const float alpha = factor.size() == 4 ? factor.at(3).get<float>() : 1.0f;
    if (mode == "BLEND") {
        if (alpha >= 1 && !m.baseColorTexture) return;
        m.coverage = std::clamp(alpha, 0.0f, 1.0f);
        if (m.transmits())
            notices.push_back("Material '" + m.name +
                              "' blends by alpha, which its glass ignores unless it is a pane.");
        return;
    }
    const float cutoff = material.value("alphaCutoff", 0.5f);
    // The format compares texture alpha × factor alpha with the cutoff; the scene knows texture alpha only, 1 without
    // one.
    m.alphaCutoff = alpha > 0 ? cutoff / alpha : cutoff > 0 ? 2.0f : 0.0f;
}

/// KHR_materials_unlit: the base colour is what a camera sees, whatever lights it.
void makeUnlit(Material& m, std::vector<std::string>& notices) {
    m.kind = MaterialKind::Lambert;
    m.emission = m.baseColor;
    m.emissionTexture = m.baseColorTexture;
    m.baseColor = Vec3f(0.0f);
    m.metallicRoughnessTexture.reset();
    m.normalTexture.reset();
    m.clearcoat = 0;
    m.sheenColor = Vec3f(0.0f);
    if (!m.alphaCutoff && !m.coverage) m.baseColorTexture.reset();
    notices.push_back("Material '" + m.name +
                      "' is unlit: it emits its base colour as radiance, which lights what is around it, too.");
}

void noticeUnsupported(const Material& m, const json& material, std::vector<std::string>& notices) {
    const json& extensions = object(material, "extensions");
    for (const char* name : {"KHR_materials_iridescence", "KHR_materials_anisotropy"}) {
        if (extensions.contains(name)) notices.push_back("Material '" + m.name + "': " + name + " is ignored.");
    }
    const json& specular = object(extensions, "KHR_materials_specular");
    if (specular.contains("specularTexture") || specular.contains("specularColorTexture"))
        notices.push_back("Material '" + m.name + "': specular textures are ignored.");
}

}  // namespace

Material readMaterial(const json* entry, const std::string& name, Textures& textures,
                      std::vector<std::string>& notices) {
    static const json empty = json::object();
    const json& material = entry ? *entry : empty;
    const json& pbr = object(material, "pbrMetallicRoughness");
    const json& extensions = object(material, "extensions");
    const json& specular = object(extensions, "KHR_materials_specular");

    Material m;
    m.name = name;
    m.baseColor = readColor(pbr, "baseColorFactor", Vec3f(1.0f));
    m.metallic = pbr.value("metallicFactor", 1.0f);
    m.roughness = pbr.value("roughnessFactor", 1.0f);
    m.specularFactor = specular.value("specularFactor", 1.0f);
    m.specular = readColor(specular, "specularColorFactor", Vec3f(1.0f));
    m.ior = object(extensions, "KHR_materials_ior").value("ior", 1.5f);
    if (m.ior < 1) {
        notices.push_back("Material '" + m.name + "': its index of refraction below 1 became 1.5.");
        m.ior = 1.5f;
    }
    m.emission = readColor(material, "emissiveFactor", Vec3f(0.0f)) *
                 object(extensions, "KHR_materials_emissive_strength").value("emissiveStrength", 1.0f);
    // doubleSided = false asks for back-face culling, a hint for rasterisers: a wall modelled as one sheet must not
    // swallow the light that reaches its back. Emission, which a culled back does not show, goes by it.
    m.twoSided = true;

    m.baseColorTexture = textures.find(object(pbr, "baseColorTexture"), TextureUse::Color);
    m.emissionTexture = textures.find(object(material, "emissiveTexture"), TextureUse::Color);
    m.metallicRoughnessTexture = textures.find(object(pbr, "metallicRoughnessTexture"), TextureUse::Data);
    m.normalTexture = textures.find(object(material, "normalTexture"), TextureUse::Data);
    m.normalScale = object(material, "normalTexture").value("scale", 1.0f);

    if (extensions.contains("KHR_materials_pbrSpecularGlossiness"))
        readSpecularGlossiness(m, extensions["KHR_materials_pbrSpecularGlossiness"], textures, notices);
    const json& transmission = object(extensions, "KHR_materials_transmission");
    setTransmission(m, extensions, textures.find(object(transmission, "transmissionTexture"), TextureUse::Data),
                    notices);
    setLayers(m, extensions, textures, notices);
    setKind(m);
    setAlpha(m, material, notices);
    if (extensions.contains("KHR_materials_unlit")) makeUnlit(m, notices);
    m.emitsBothSides = m.emits() && material.value("doubleSided", false);
    noticeUnsupported(m, material, notices);
    return m;
}

}  // namespace antipode::gltf
