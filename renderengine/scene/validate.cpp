// The gate that every scene passes before it is rendered.
#include <cmath>
#include <numbers>
#include <string>

#include "renderengine/error.h"
#include "renderengine/scene.h"
#include "renderengine/settings.h"
#include "scene/defaults.h"
#include "scene/mesh_cleanup.h"
#include "scene/units.h"

namespace antipode {
namespace {

void require(bool holds, const std::string& object, const std::string& otherwise) {
    if (!holds) throw Error(ErrorCode::Input, object + ": " + otherwise);
}

std::string label(const char* kind, size_t index, const std::string& name) {
    if (name.empty()) return std::string(kind).append(" #").append(std::to_string(index));
    return std::string(kind).append(" '").append(name).append("'");
}

/// NaN fails every comparison below, so a range check is a finiteness check, too.
bool inRange(float v, float low, float high) { return v >= low && v <= high; }
bool inUnitCube(const Vec3f& c) { return inRange(c.x, 0, 1) && inRange(c.y, 0, 1) && inRange(c.z, 0, 1); }
bool isPower(const Vec3f& c) { return isFinite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0; }
bool isUnit(const Vec3f& v) { return std::abs(length(Vec3d(v)) - 1) < 1e-3; }

void checkTexture(const Texture& t, const std::string& what) {
    require(t.width > 0 && t.height > 0, what, "has no texels");
    // Divided rather than multiplied: 2^31 × 2^31 texels of four bytes are 0 in 64 bits.
    const size_t texels = t.rgba.size() / 4;
    require(t.rgba.size() % 4 == 0 && texels % t.width == 0 && texels / t.width == t.height, what,
            "holds " + std::to_string(t.rgba.size()) + " bytes instead of width × height × 4");
}

void checkMaterial(const Material& m, size_t textureCount, const std::string& what) {
    require(inUnitCube(m.baseColor), what, "base colour lies outside [0,1]");
    require(isPower(m.specular), what, "specular colour is negative or not finite");
    if (m.kind == MaterialKind::Phong || m.kind == MaterialKind::Mirror)
        require(inUnitCube(m.specular), what, "specular reflectance lies outside [0,1]");
    if (m.kind == MaterialKind::Phong) {
        // One rounding of the sum is forgiven: .3 + .7 must pass.
        require(maxComponent(m.baseColor + m.specular) <= 1.000001f, what,
                "diffuse and specular reflectance add up to more than 1");
    }
    require(inRange(m.specularFactor, 0, 1), what, "specular factor lies outside [0,1]");
    require(std::isfinite(m.phongExponent) && m.phongExponent >= 0, what, "Phong exponent is negative or not finite");
    require(inRange(m.roughness, 0, 1), what, "roughness lies outside [0,1]");
    require(inRange(m.metallic, 0, 1), what, "metallic lies outside [0,1]");
    require(std::isfinite(m.ior) && m.ior >= 1, what, "index of refraction is below 1 or not finite");
    require(isPower(m.conductorEta) && isPower(m.conductorK), what, "complex index is negative or not finite");
    require(isPower(m.emission), what, "emission is negative or not finite");
    require(std::isfinite(m.normalScale), what, "normal scale is not finite");
    require(!m.alphaCutoff || std::isfinite(*m.alphaCutoff), what, "alpha cutoff is not finite");
    for (const TextureIndex& index :
         {m.baseColorTexture, m.emissionTexture, m.metallicRoughnessTexture, m.normalTexture}) {
        require(!index || *index < textureCount, what, "refers to a texture that does not exist");
    }
}

// Beyond, differences of coordinates overflow; scenes that are smaller have lengths that are no longer normal floats.
constexpr float farthest = 1e30f;
constexpr double smallestRadius = 1e-30;
constexpr float narrowestSpot = 1e-6f;
const char* const tooFar = "reaches further than 1e30 units from the origin, more than single precision holds";

bool isNear(const Vec3f& p) {
    return inRange(p.x, -farthest, farthest) && inRange(p.y, -farthest, farthest) && inRange(p.z, -farthest, farthest);
}

void checkSurfaces(const Scene& scene) {
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const std::string what = label("mesh", i, mesh.name);
        require(!mesh.triangles.empty(), what, "has no triangles");
        require(mesh.material < scene.materials.size(), what, "refers to a material that does not exist");
        checkMesh(mesh);
        for (const Vec3f& p : mesh.positions) require(isNear(p), what, tooFar);
        for (const Vec3f& n : mesh.normals) require(isUnit(n), what, "has a normal that is not of unit length");
    }
    for (size_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere& sphere = scene.spheres[i];
        const std::string what = label("sphere", i, "");
        require(isFinite(sphere.center), what, "centre is not finite");
        require(std::isfinite(sphere.radius) && sphere.radius > 0, what, "radius is not positive");
        require(isNear(sphere.center) && sphere.radius <= farthest, what, tooFar);
        require(sphere.material < scene.materials.size(), what, "refers to a material that does not exist");
    }
    require(!scene.meshes.empty() || !scene.spheres.empty(), "scene '" + scene.name + "'", "holds no surface");
    require(boundingRadius(scene) >= smallestRadius, "scene '" + scene.name + "'",
            "is smaller than 1e-30 units, less than single precision holds");
}

void checkDeltaLights(const Scene& scene) {
    for (size_t i = 0; i < scene.pointLights.size(); ++i) {
        const std::string what = label("point light", i, "");
        require(isFinite(scene.pointLights[i].position), what, "position is not finite");
        require(isPower(scene.pointLights[i].intensity), what, "intensity is negative or not finite");
    }
    for (size_t i = 0; i < scene.spotLights.size(); ++i) {
        const SpotLight& light = scene.spotLights[i];
        const std::string what = label("spot light", i, "");
        require(isFinite(light.position), what, "position is not finite");
        require(isUnit(light.direction), what, "direction is not of unit length");
        require(isPower(light.intensity), what, "intensity is negative or not finite");
        require(light.innerHalfAngle >= 0 && light.innerHalfAngle < light.outerHalfAngle &&
                    light.outerHalfAngle <= std::numbers::pi_v<float>,
                what, "half-angles must satisfy 0 ≤ inner < outer ≤ 180°");
        require(light.outerHalfAngle >= narrowestSpot, what,
                "outer half-angle is below 1e-6 radians, narrower than single precision's directions");
    }
    for (size_t i = 0; i < scene.directionalLights.size(); ++i) {
        const std::string what = label("directional light", i, "");
        require(isUnit(scene.directionalLights[i].direction), what, "direction is not of unit length");
        require(isPower(scene.directionalLights[i].irradiance), what, "irradiance is negative or not finite");
    }
}

void checkEnvironment(const Environment& e) {
    const std::string what = "environment";
    require(isPower(e.radiance), what, "radiance is negative or not finite");
    require(std::isfinite(e.rotation), what, "rotation is not finite");
    require(e.map.size() == size_t(e.width) * e.height && (e.width == 0) == (e.height == 0), what,
            "map does not hold width × height values");
    for (const Vec3f& value : e.map) require(isPower(value), what, "map has a negative or non-finite value");
}

void checkCamera(const Camera& c) {
    const std::string what = "camera";
    require(isFinite(c.position), what, "position is not finite");
    require(isUnit(c.forward), what, "viewing direction is not of unit length");
    require(isUnit(c.up), what, "up direction is not of unit length");
    require(length(cross(Vec3d(c.forward), Vec3d(c.up))) > 1e-4, what, "up is parallel to the viewing direction");
    require(c.verticalFov > 0 && c.verticalFov < std::numbers::pi_v<float>, what,
            "vertical field of view lies outside (0°, 180°)");
    require(std::isfinite(c.lensRadius) && c.lensRadius >= 0, what, "lens radius is negative or not finite");
    require(std::isfinite(c.focusDistance) && c.focusDistance > 0, what, "focus distance is not positive");
}

}  // namespace

void validate(const Scene& scene) {
    for (size_t i = 0; i < scene.textures.size(); ++i)
        checkTexture(scene.textures[i], label("texture", i, scene.textures[i].name));
    for (size_t i = 0; i < scene.materials.size(); ++i)
        checkMaterial(scene.materials[i], scene.textures.size(), label("material", i, scene.materials[i].name));
    checkSurfaces(scene);
    checkDeltaLights(scene);
    if (scene.environment) checkEnvironment(*scene.environment);
    checkCamera(scene.camera);
    require(scene.imageWidth > 0 && scene.imageHeight > 0, "image", "width and height must be at least 1");
    require(!scene.maxPathLength || (*scene.maxPathLength > 0 && *scene.maxPathLength <= SettingsLimits::pathLength),
            "scene '" + scene.name + "'",
            "max_path_length must be between 1 and " + std::to_string(SettingsLimits::pathLength));
    require(hasLight(scene), "scene '" + scene.name + "'", "holds no light: nothing in it emits");
}

}  // namespace antipode
