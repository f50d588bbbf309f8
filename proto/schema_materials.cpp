#include "proto/schema_materials.h"

#include <algorithm>
#include <initializer_list>

#include "proto/schema_values.h"

namespace antipode {
namespace {

using Kind = schema::Material;

/// Fields that only some kinds look at, and which do.
struct FieldUse {
    const char* field;
    std::initializer_list<schema::Material::Kind> kinds;
};
const FieldUse kFieldUses[] = {
    {"base_color", {Kind::LAMBERT, Kind::PHONG, Kind::METALLIC_ROUGHNESS}},
    {"base_color_texture", {Kind::LAMBERT, Kind::PHONG, Kind::METALLIC_ROUGHNESS}},
    {"specular", {Kind::PHONG, Kind::MIRROR, Kind::METALLIC_ROUGHNESS}},
    {"specular_factor", {Kind::METALLIC_ROUGHNESS}},
    {"phong_exponent", {Kind::PHONG}},
    {"roughness", {Kind::ROUGH_CONDUCTOR, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"metallic", {Kind::METALLIC_ROUGHNESS}},
    {"metallic_roughness_texture", {Kind::ROUGH_CONDUCTOR, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"ior", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"conductor_eta", {Kind::ROUGH_CONDUCTOR}},
    {"conductor_k", {Kind::ROUGH_CONDUCTOR}},
};

void noticeUnusedFields(const schema::Material& m, std::vector<std::string>& notices) {
    // base_color_texture also carries the alpha of cut-outs, whatever the kind.
    std::vector<const google::protobuf::FieldDescriptor*> set;
    m.GetReflection()->ListFields(m, &set);
    for (const FieldUse& use : kFieldUses) {
        const bool used = std::find(use.kinds.begin(), use.kinds.end(), m.kind()) != use.kinds.end();
        const bool present = std::any_of(set.begin(), set.end(), [&](auto* f) { return f->name() == use.field; });
        const bool cutOut = m.has_alpha_cutoff() && use.field == std::string("base_color_texture");
        if (present && !used && !cutOut)
            notices.push_back("Material '" + m.name() + "': " + use.field + " has no effect on " +
                              schema::Material::Kind_Name(m.kind()) + ".");
    }
}

/// The engine's enumerators stand in the schema's order.
static_assert(int(MaterialKind::Lambert) == Kind::LAMBERT && int(MaterialKind::Phong) == Kind::PHONG &&
              int(MaterialKind::Mirror) == Kind::MIRROR && int(MaterialKind::Dielectric) == Kind::DIELECTRIC &&
              int(MaterialKind::RoughConductor) == Kind::ROUGH_CONDUCTOR &&
              int(MaterialKind::RoughDielectric) == Kind::ROUGH_DIELECTRIC &&
              int(MaterialKind::MetallicRoughness) == Kind::METALLIC_ROUGHNESS);

}  // namespace

Material readMaterial(const schema::Material& from, const TextureLookup& textures, std::vector<std::string>& notices) {
    const std::string where = "material '" + from.name() + "': ";
    if (!schema::Material::Kind_IsValid(from.kind())) failAt(where + "kind", "is unknown");
    Material m;
    m.name = from.name();
    m.kind = MaterialKind(from.kind());
    m.baseColor = readVec3(from.base_color(), where + "base_color", m.baseColor);
    m.specular = readVec3(from.specular(), where + "specular", m.specular);
    if (from.has_specular_factor()) m.specularFactor = from.specular_factor();
    if (from.has_phong_exponent()) m.phongExponent = from.phong_exponent();
    if (from.has_roughness()) m.roughness = from.roughness();
    m.metallic = from.metallic();
    if (from.has_ior()) m.ior = from.ior();
    m.conductorEta = readVec3(from.conductor_eta(), where + "conductor_eta", m.conductorEta);
    m.conductorK = readVec3(from.conductor_k(), where + "conductor_k", m.conductorK);
    m.emission = readVec3(from.emission(), where + "emission", m.emission);
    const auto texture = [&](const std::string& reference, const char* field) -> TextureIndex {
        if (reference.empty()) return {};
        return textures(reference, where + field);
    };
    m.baseColorTexture = texture(from.base_color_texture(), "base_color_texture");
    m.emissionTexture = texture(from.emission_texture(), "emission_texture");
    m.metallicRoughnessTexture = texture(from.metallic_roughness_texture(), "metallic_roughness_texture");
    m.normalTexture = texture(from.normal_texture(), "normal_texture");
    if (from.has_normal_scale()) m.normalScale = from.normal_scale();
    if (from.has_alpha_cutoff()) m.alphaCutoff = from.alpha_cutoff();
    m.twoSided = !from.one_sided();
    m.emitsBothSides = from.emits_both_sides();
    noticeUnusedFields(from, notices);
    return m;
}

void writeMaterial(const Material& m, schema::Material* out) {
    out->set_name(m.name);
    out->set_kind(schema::Material::Kind(m.kind));
    writeVec3(m.baseColor, out->mutable_base_color());
    writeVec3(m.specular, out->mutable_specular());
    out->set_specular_factor(m.specularFactor);
    out->set_phong_exponent(m.phongExponent);
    out->set_roughness(m.roughness);
    out->set_metallic(m.metallic);
    out->set_ior(m.ior);
    writeVec3(m.conductorEta, out->mutable_conductor_eta());
    writeVec3(m.conductorK, out->mutable_conductor_k());
    writeVec3(m.emission, out->mutable_emission());
    const auto reference = [](const TextureIndex& index) {
        return index ? std::string("#").append(std::to_string(*index)) : std::string();
    };
    out->set_base_color_texture(reference(m.baseColorTexture));
    out->set_emission_texture(reference(m.emissionTexture));
    out->set_metallic_roughness_texture(reference(m.metallicRoughnessTexture));
    out->set_normal_texture(reference(m.normalTexture));
    out->set_normal_scale(m.normalScale);
    if (m.alphaCutoff) out->set_alpha_cutoff(*m.alphaCutoff);
    out->set_one_sided(!m.twoSided);
    out->set_emits_both_sides(m.emitsBothSides);
}

}  // namespace antipode
