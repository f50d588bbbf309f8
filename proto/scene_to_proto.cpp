#include "proto/schema_materials.h"
#include "proto/schema_values.h"
#include "proto/scene_translation.h"

namespace antipode {
namespace {

/// The engine's enumerators stand in the schema's order.
static_assert(int(WrapMode::Repeat) == schema::Texture::REPEAT && int(WrapMode::Mirror) == schema::Texture::MIRROR &&
              int(WrapMode::Clamp) == schema::Texture::CLAMP);

std::string materialReference(uint32_t index) { return std::string("#").append(std::to_string(index)); }

void writeTexture(const Texture& t, Arrays arrays, schema::Texture* out) {
    out->set_name(t.name);
    out->mutable_texels()->set_width(t.width);
    out->mutable_texels()->set_height(t.height);
    if (arrays == Arrays::Included) out->mutable_texels()->set_rgba(t.rgba.data(), t.rgba.size());
    out->set_linear(!t.srgb);
    out->set_wrap_u(schema::Texture::Wrap(t.wrapU));
    out->set_wrap_v(schema::Texture::Wrap(t.wrapV));
}

void writeMesh(const Mesh& mesh, Arrays arrays, schema::Mesh* out) {
    out->set_name(mesh.name);
    out->set_material(materialReference(mesh.material));
    if (arrays == Arrays::LeftOut) return;
    out->mutable_positions()->Reserve(int(mesh.positions.size() * 3));
    out->mutable_normals()->Reserve(int(mesh.normals.size() * 3));
    out->mutable_uvs()->Reserve(int(mesh.uvs.size() * 2));
    out->mutable_triangles()->Reserve(int(mesh.triangles.size() * 3));
    for (const Vec3f& p : mesh.positions) writeVec3(p, out->mutable_positions());
    for (const Vec3f& n : mesh.normals) writeVec3(n, out->mutable_normals());
    for (const auto& uv : mesh.uvs)
        for (float c : uv) out->add_uvs(c);
    for (const auto& triangle : mesh.triangles)
        for (uint32_t index : triangle) out->add_triangles(index);
}

void writeLights(const Scene& scene, schema::Scene& out) {
    for (const PointLight& light : scene.pointLights) {
        auto* to = out.add_point_light();
        writeVec3(light.position, to->mutable_position());
        writeVec3(light.intensity, to->mutable_intensity());
    }
    for (const SpotLight& light : scene.spotLights) {
        auto* to = out.add_spot_light();
        writeVec3(light.position, to->mutable_position());
        writeVec3(light.direction, to->mutable_direction());
        writeVec3(light.intensity, to->mutable_intensity());
        to->set_inner_half_angle(toDegrees(light.innerHalfAngle));
        to->set_outer_half_angle(toDegrees(light.outerHalfAngle));
    }
    for (const DirectionalLight& light : scene.directionalLights) {
        auto* to = out.add_directional_light();
        writeVec3(light.direction, to->mutable_direction());
        writeVec3(light.irradiance, to->mutable_irradiance());
    }
}

void writeEnvironment(const Environment& e, Arrays arrays, schema::Environment* out) {
    writeVec3(e.radiance, out->mutable_radiance());
    out->set_rotation(toDegrees(e.rotation));
    out->set_z_up(e.zUp);
    if (e.map.empty()) return;
    out->mutable_map()->set_width(e.width);
    out->mutable_map()->set_height(e.height);
    if (arrays == Arrays::LeftOut) return;
    for (const Vec3f& value : e.map) writeVec3(value, out->mutable_map()->mutable_rgb());
}

void writeCamera(const Camera& c, schema::Camera* out) {
    writeVec3(c.position, out->mutable_position());
    writeVec3(c.forward, out->mutable_forward());
    writeVec3(c.up, out->mutable_up());
    out->set_vertical_fov(toDegrees(c.verticalFov));
    out->set_lens_radius(c.lensRadius);
    out->set_focus_distance(c.focusDistance);
}

}  // namespace

schema::Scene toProto(const Scene& scene, Arrays arrays) {
    schema::Scene out;
    out.set_name(scene.name);
    writeCamera(scene.camera, out.mutable_camera());
    out.mutable_image()->set_width(scene.imageWidth);
    out.mutable_image()->set_height(scene.imageHeight);
    if (scene.maxPathLength) out.set_max_path_length(*scene.maxPathLength);
    for (const Texture& texture : scene.textures) writeTexture(texture, arrays, out.add_texture());
    for (const Material& material : scene.materials) writeMaterial(material, out.add_material());
    for (const Mesh& mesh : scene.meshes) writeMesh(mesh, arrays, out.add_mesh());
    for (const Sphere& sphere : scene.spheres) {
        auto* to = out.add_sphere();
        writeVec3(sphere.center, to->mutable_center());
        to->set_radius(sphere.radius);
        to->set_material(materialReference(sphere.material));
    }
    writeLights(scene, out);
    if (scene.environment) writeEnvironment(*scene.environment, arrays, out.mutable_environment());
    for (const std::string& notice : scene.notices) out.add_notice(notice);
    return out;
}

}  // namespace antipode
