#include "proto/schema_materials.h"

#include <algorithm>
#include <initializer_list>

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
    {"abbe_number", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"conductor_eta", {Kind::ROUGH_CONDUCTOR}},
    {"conductor_k", {Kind::ROUGH_CONDUCTOR}},
    {"priority", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"transmission", {Kind::METALLIC_ROUGHNESS}},
    {"transmission_texture", {Kind::METALLIC_ROUGHNESS}},
    {"clearcoat", {Kind::METALLIC_ROUGHNESS}},
    {"clearcoat_roughness", {Kind::METALLIC_ROUGHNESS}},
    {"clearcoat_texture", {Kind::METALLIC_ROUGHNESS}},
    {"clearcoat_roughness_texture", {Kind::METALLIC_ROUGHNESS}},
    {"sheen_color", {Kind::METALLIC_ROUGHNESS}},
    {"sheen_roughness", {Kind::METALLIC_ROUGHNESS}},
    {"sheen_color_texture", {Kind::METALLIC_ROUGHNESS}},
    {"sheen_roughness_texture", {Kind::METALLIC_ROUGHNESS}},
    {"thin", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"attenuation_color", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"attenuation_distance", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"scattering_color", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"scattering_distance", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
    {"scattering_anisotropy", {Kind::DIELECTRIC, Kind::ROUGH_DIELECTRIC, Kind::METALLIC_ROUGHNESS}},
};

void noticeUnusedFields(const schema::Material& m, std::vector<std::string>& notices) {
    // base_color_texture also carries the alpha of cut-outs, whatever the kind.
    std::vector<const google::protobuf::FieldDescriptor*> set;
    m.GetReflection()->ListFields(m, &set);
    for (const FieldUse& use : kFieldUses) {
        const bool used = std::find(use.kinds.begin(), use.kinds.end(), m.kind()) != use.kinds.end();
        const bool present = std::any_of(set.begin(), set.end(), [&](auto* f) { return f->name() == use.field; });
        const bool cutOut =
            (m.has_alpha_cutoff() || m.has_coverage()) && use.field == std::string("base_color_texture");
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

Material readMaterial(const schema::Material& from, const ReadContext& context, std::vector<std::string>& notices) {
    Material material;
    readFields(from, "material '" + from.name() + "'", context, material);
    noticeUnusedFields(from, notices);
    return material;
}

}  // namespace antipode
