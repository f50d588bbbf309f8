#include <optional>
#include <span>

#include "digest/sha256.h"
#include "proto/scene_loader.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

static_assert(sizeof(Vec3f) == 12, "three floats without padding");

/// SHA-256 over a sequence of values. Every list is preceded by its length, so that no two scenes give the same bytes.
class Hasher {
public:
    void add(uint64_t v) { digest_.addValue(v); }
    void add(float v) { digest_.addValue(v); }
    void add(const Vec3f& v) { digest_.addValues(std::span(&v, 1)); }
    template <class T>
    void add(const std::optional<T>& v) {
        add(uint64_t(v.has_value()));
        if (v) add(*v);
    }
    void add(const std::optional<uint32_t>& v) { add(v ? std::optional<uint64_t>(*v) : std::nullopt); }
    template <class T>
    void addArray(const std::vector<T>& values) {
        add(uint64_t(values.size()));
        digest_.addValues(std::span<const T>(values));
    }

    std::string hex() { return hexadecimal(digest_.finish()); }

private:
    Sha256 digest_;
};

void hashTexture(Hasher& h, const Texture& t) {
    h.add(uint64_t(t.width)), h.add(uint64_t(t.height)), h.addArray(t.rgba);
    h.add(uint64_t(t.srgb)), h.add(uint64_t(t.wrapU)), h.add(uint64_t(t.wrapV));
}

void hashMaterial(Hasher& h, const Material& m) {
    h.add(uint64_t(m.kind)), h.add(m.baseColor), h.add(m.specular), h.add(m.specularFactor), h.add(m.phongExponent);
    h.add(m.roughness), h.add(m.metallic), h.add(m.ior), h.add(m.conductorEta), h.add(m.conductorK), h.add(m.emission);
    h.add(m.baseColorTexture), h.add(m.emissionTexture), h.add(m.metallicRoughnessTexture), h.add(m.normalTexture);
    h.add(m.normalScale), h.add(m.alphaCutoff), h.add(uint64_t(m.twoSided)), h.add(uint64_t(m.emitsBothSides));
}

void hashMesh(Hasher& h, const Mesh& m) {
    h.addArray(m.positions), h.addArray(m.normals), h.addArray(m.uvs), h.addArray(m.triangles),
        h.add(uint64_t(m.material));
}

void hashLights(Hasher& h, const Scene& scene) {
    h.add(uint64_t(scene.pointLights.size()));
    for (const PointLight& l : scene.pointLights) h.add(l.position), h.add(l.intensity);
    h.add(uint64_t(scene.spotLights.size()));
    for (const SpotLight& l : scene.spotLights)
        h.add(l.position), h.add(l.direction), h.add(l.intensity), h.add(l.innerHalfAngle), h.add(l.outerHalfAngle);
    h.add(uint64_t(scene.directionalLights.size()));
    for (const DirectionalLight& l : scene.directionalLights) h.add(l.direction), h.add(l.irradiance);
    h.add(uint64_t(scene.environment.has_value()));
    if (!scene.environment) return;
    const Environment& e = *scene.environment;
    h.add(e.radiance), h.add(uint64_t(e.width)), h.add(uint64_t(e.height)), h.addArray(e.map), h.add(e.rotation);
    h.add(uint64_t(e.zUp));
}

}  // namespace

std::string sceneHash(const Scene& scene) {
    Hasher h;
    h.add(uint64_t(1));  // the layout's version: a change below must change every hash
    h.add(uint64_t(scene.textures.size()));
    for (const Texture& texture : scene.textures) hashTexture(h, texture);
    h.add(uint64_t(scene.materials.size()));
    for (const Material& material : scene.materials) hashMaterial(h, material);
    h.add(uint64_t(scene.meshes.size()));
    for (const Mesh& mesh : scene.meshes) hashMesh(h, mesh);
    h.add(uint64_t(scene.spheres.size()));
    for (const Sphere& s : scene.spheres) h.add(s.center), h.add(s.radius), h.add(uint64_t(s.material));
    hashLights(h, scene);
    const Camera& c = scene.camera;
    h.add(c.position), h.add(c.forward), h.add(c.up), h.add(c.verticalFov), h.add(c.lensRadius), h.add(c.focusDistance);
    h.add(uint64_t(scene.imageWidth)), h.add(uint64_t(scene.imageHeight)), h.add(scene.maxPathLength);
    return h.hex();
}

}  // namespace antipode
