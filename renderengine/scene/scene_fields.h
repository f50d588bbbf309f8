// The fields of a scene's structs, by their names in the schema (proto/scene.proto). The scene's hash, its translation
// to and from the schema, validation, moves and units walk these tables: a new field is a row here and one in the
// schema.
#pragma once

#include <limits>

#include "renderengine/field_table.h"
#include "renderengine/scene.h"

namespace antipode {

/// What a field is: what moves, scales or checks it, and how the schema writes it.
enum class Role {
    Name,        ///< told to people; not hashed
    Part,        ///< structs with tables of their own
    Light,       ///< likewise, of what lights the scene besides surfaces
    Position,    ///< moves and scales with the scene
    Direction,   ///< of unit length; the schema's may have any
    Length,      ///< scales with the scene
    Intensity,   ///< W/sr; scales with the square of lengths
    Irradiance,  ///< W/m²
    Radiance,    ///< W/(m² sr)
    Fraction,    ///< in [0,1]
    Angle,       ///< radians; the schema's are degrees
    Number,
    Count,
    Choice,  ///< an enumeration, whose numbers the schema shares
    Flag,
    Opposite,  ///< a flag of which the schema says the opposite
    Texture,   ///< an index among the scene's textures; the schema refers to them by "#N" or name
    Material,  ///< likewise among its materials
    Data,      ///< values of images and triangles, which are checked together
};

/// What a number, or each component of a vector, has to be. No NaN is in a range.
struct Range {
    float least, greatest;
    const char* otherwise;  ///< what is said of one outside
    bool needed = false;    ///< the schema has no default

    bool holds(float v) const { return v >= least && v <= greatest; }
    bool holds(const Vec3f& v) const { return holds(v.x) && holds(v.y) && holds(v.z); }
};

constexpr float largestFloat = std::numeric_limits<float>::max(), leastFloat = std::numeric_limits<float>::denorm_min();
constexpr Range finite{-largestFloat, largestFloat, "is not finite"};
constexpr Range nonNegative{0, largestFloat, "is negative or not finite"};
constexpr Range positive{leastFloat, largestFloat, "is not positive"};
constexpr Range atLeastOne{1, largestFloat, "is below 1 or not finite"};
constexpr Range unitInterval{0, 1, "lies outside [0,1]"};
constexpr Range meanCosine{-0.999f, 0.999f, "lies outside [-0.999, 0.999]"};
constexpr Range belowHalfTurn{leastFloat, 0x1.921fb4p+1f, "lies outside (0°, 180°)"};

constexpr Range rangeOf(Role role) {
    switch (role) {
        case Role::Length:
        case Role::Intensity:
        case Role::Irradiance:
        case Role::Radiance: return nonNegative;
        case Role::Fraction: return unitInterval;
        default: return finite;
    }
}

template <Role role, class S, class V>
constexpr Field<role, S, V, Range> field(const char* name, V S::*member, Range range = rangeOf(role)) {
    return {name, member, range};
}

/// A field without which the schema's object makes no sense.
template <Role role, class S, class V>
constexpr Field<role, S, V, Range> needed(const char* name, V S::*member) {
    Range range = rangeOf(role);
    range.needed = true;
    return {name, member, range};
}

constexpr auto fieldsOf(Of<Texture>) {
    return std::tuple{
        field<Role::Name>("name", &Texture::name),
        field<Role::Count>("texels.width", &Texture::width),
        field<Role::Count>("texels.height", &Texture::height),
        field<Role::Data>("texels.rgba", &Texture::rgba),
        field<Role::Opposite>("linear", &Texture::srgb),
        field<Role::Choice>("wrap_u", &Texture::wrapU),
        field<Role::Choice>("wrap_v", &Texture::wrapV),
        field<Role::Flag>("nearest", &Texture::nearest),
        field<Role::Count>("uv_set", &Texture::uvSet),
    };
}

constexpr auto fieldsOf(Of<Material>) {
    return std::tuple{
        field<Role::Name>("name", &Material::name),
        field<Role::Choice>("kind", &Material::kind),
        field<Role::Fraction>("base_color", &Material::baseColor),
        field<Role::Number>("specular", &Material::specular, nonNegative),
        field<Role::Fraction>("specular_factor", &Material::specularFactor),
        field<Role::Number>("phong_exponent", &Material::phongExponent, nonNegative),
        field<Role::Fraction>("roughness", &Material::roughness),
        field<Role::Fraction>("metallic", &Material::metallic),
        field<Role::Number>("ior", &Material::ior, atLeastOne),
        field<Role::Number>("abbe_number", &Material::abbeNumber, atLeastOne),
        field<Role::Number>("conductor_eta", &Material::conductorEta, nonNegative),
        field<Role::Number>("conductor_k", &Material::conductorK, nonNegative),
        field<Role::Fraction>("transmission", &Material::transmission),
        field<Role::Flag>("thin", &Material::thin),
        field<Role::Fraction>("clearcoat", &Material::clearcoat),
        field<Role::Fraction>("clearcoat_roughness", &Material::clearcoatRoughness),
        field<Role::Fraction>("sheen_color", &Material::sheenColor),
        field<Role::Fraction>("sheen_roughness", &Material::sheenRoughness),
        field<Role::Fraction>("attenuation_color", &Material::attenuationColor),
        field<Role::Length>("attenuation_distance", &Material::attenuationDistance, positive),
        field<Role::Fraction>("scattering_color", &Material::scatteringColor),
        field<Role::Length>("scattering_distance", &Material::scatteringDistance, positive),
        field<Role::Number>("scattering_anisotropy", &Material::scatteringAnisotropy, meanCosine),
        field<Role::Radiance>("emission", &Material::emission),
        field<Role::Texture>("base_color_texture", &Material::baseColorTexture),
        field<Role::Texture>("emission_texture", &Material::emissionTexture),
        field<Role::Texture>("metallic_roughness_texture", &Material::metallicRoughnessTexture),
        field<Role::Texture>("normal_texture", &Material::normalTexture),
        field<Role::Texture>("transmission_texture", &Material::transmissionTexture),
        field<Role::Texture>("clearcoat_texture", &Material::clearcoatTexture),
        field<Role::Texture>("clearcoat_roughness_texture", &Material::clearcoatRoughnessTexture),
        field<Role::Texture>("sheen_color_texture", &Material::sheenColorTexture),
        field<Role::Texture>("sheen_roughness_texture", &Material::sheenRoughnessTexture),
        field<Role::Number>("normal_scale", &Material::normalScale),
        field<Role::Number>("alpha_cutoff", &Material::alphaCutoff),
        field<Role::Fraction>("coverage", &Material::coverage),
        field<Role::Opposite>("one_sided", &Material::twoSided),
        field<Role::Flag>("emits_both_sides", &Material::emitsBothSides),
        field<Role::Count>("priority", &Material::priority),
    };
}

constexpr auto fieldsOf(Of<Mesh>) {
    return std::tuple{
        field<Role::Name>("name", &Mesh::name),
        field<Role::Position>("positions", &Mesh::positions),
        field<Role::Direction>("normals", &Mesh::normals),
        field<Role::Data>("uvs", &Mesh::uvs),
        field<Role::Data>("triangles", &Mesh::triangles),
        field<Role::Material>("material", &Mesh::material),
        field<Role::Data>("more_uvs", &Mesh::moreUvs),
        field<Role::Data>("colors", &Mesh::colors),
        field<Role::Data>("tangents", &Mesh::tangents),
    };
}

constexpr auto fieldsOf(Of<Sphere>) {
    return std::tuple{
        field<Role::Position>("center", &Sphere::center),
        field<Role::Length>("radius", &Sphere::radius, positive),
        field<Role::Material>("material", &Sphere::material),
    };
}

constexpr auto fieldsOf(Of<PointLight>) {
    return std::tuple{
        needed<Role::Position>("position", &PointLight::position),
        needed<Role::Intensity>("intensity", &PointLight::intensity),
    };
}

constexpr auto fieldsOf(Of<SpotLight>) {
    return std::tuple{
        needed<Role::Position>("position", &SpotLight::position),
        needed<Role::Direction>("direction", &SpotLight::direction),
        needed<Role::Intensity>("intensity", &SpotLight::intensity),
        field<Role::Angle>("inner_half_angle", &SpotLight::innerHalfAngle),
        field<Role::Angle>("outer_half_angle", &SpotLight::outerHalfAngle),
    };
}

constexpr auto fieldsOf(Of<DirectionalLight>) {
    return std::tuple{
        needed<Role::Direction>("direction", &DirectionalLight::direction),
        needed<Role::Irradiance>("irradiance", &DirectionalLight::irradiance),
    };
}

constexpr auto fieldsOf(Of<Environment>) {
    return std::tuple{
        field<Role::Radiance>("radiance", &Environment::radiance), field<Role::Count>("map.width", &Environment::width),
        field<Role::Count>("map.height", &Environment::height),    field<Role::Radiance>("map.rgb", &Environment::map),
        field<Role::Angle>("rotation", &Environment::rotation),    field<Role::Flag>("z_up", &Environment::zUp),
    };
}

constexpr auto fieldsOf(Of<Camera>) {
    return std::tuple{
        needed<Role::Position>("position", &Camera::position),
        field<Role::Direction>("forward", &Camera::forward),
        field<Role::Direction>("up", &Camera::up),
        field<Role::Angle>("vertical_fov", &Camera::verticalFov, belowHalfTurn),
        field<Role::Length>("lens_radius", &Camera::lensRadius),
        field<Role::Length>("focus_distance", &Camera::focusDistance, positive),
        field<Role::Length>("orthographic_height", &Camera::orthographicHeight),
    };
}

constexpr auto fieldsOf(Of<Scene>) {
    return std::tuple{
        field<Role::Name>("name", &Scene::name),
        field<Role::Part>("texture", &Scene::textures),
        field<Role::Part>("material", &Scene::materials),
        field<Role::Part>("mesh", &Scene::meshes),
        field<Role::Part>("sphere", &Scene::spheres),
        field<Role::Light>("point_light", &Scene::pointLights),
        field<Role::Light>("spot_light", &Scene::spotLights),
        field<Role::Light>("directional_light", &Scene::directionalLights),
        field<Role::Light>("environment", &Scene::environment),
        field<Role::Part>("camera", &Scene::camera),
        field<Role::Count>("image.width", &Scene::imageWidth),
        field<Role::Count>("image.height", &Scene::imageHeight),
        field<Role::Count>("max_path_length", &Scene::maxPathLength),
        field<Role::Name>("notice", &Scene::notices),
    };
}

/// Calls visit for each light of every kind, surfaces apart.
template <class Visit>
void forEachLight(const Scene& scene, const Visit& visit) {
    forEachField(scene, [&](auto field, const auto& lights) {
        if constexpr (field.role == Role::Light) forEachEntry(lights, visit);
    });
}

}  // namespace antipode
