// The gate that every scene passes before it is rendered.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "renderengine/error.h"
#include "renderengine/scene.h"
#include "renderengine/settings.h"
#include "scene/defaults.h"
#include "scene/mesh_cleanup.h"
#include "scene/mesh_fronts.h"
#include "scene/scene_fields.h"
#include "scene/units.h"

namespace antipode {
namespace {

void require(bool holds, const std::string& object, const std::string& otherwise) {
    if (!holds) throw Error(ErrorCode::Input, object + ": " + otherwise);
}

bool isUnit(const Vec3f& v) { return std::abs(length(Vec3d(v)) - 1) < 1e-3; }

/// Every field by itself, as its row says.
template <class S>
void checkFields(const S& object, const std::string& what, const Scene& scene) {
    forEachField(object, [&](auto field, const auto& values) {
        constexpr Role role = field.role;
        forEachEntry(values, [&](const auto& value) {
            using Value = std::remove_cvref_t<decltype(value)>;
            const auto requireOf = [&](bool holds, const char* otherwise) {
                if (!holds) require(false, what, std::string(field.name) + " " + otherwise);
            };
            if constexpr (role == Role::Direction)
                requireOf(isUnit(value), "is not of unit length");
            else if constexpr (role == Role::Texture)
                requireOf(value < scene.textures.size(), "refers to a texture that does not exist");
            else if constexpr (role == Role::Material)
                requireOf(value < scene.materials.size(), "refers to a material that does not exist");
            else if constexpr (std::is_same_v<Value, float> || std::is_same_v<Value, Vec3f>)
                requireOf(field.range.holds(value), field.range.otherwise);
        });
    });
}

// What fields have to be together. Of structs without a function of their own, nothing.

template <class S>
void checkTogether(const S&, const std::string&) {}

constexpr uint32_t greatestUvSet = 15;  // every triangle has room for all up to the greatest that is used

void checkTogether(const Texture& t, const std::string& what) {
    require(t.width > 0 && t.height > 0, what, "has no texels");
    require(t.uvSet <= greatestUvSet, what, "uv_set is greater than 15");
    // Divided rather than multiplied: 2^31 × 2^31 texels of four bytes are 0 in 64 bits.
    const size_t texels = t.rgba.size() / 4;
    require(t.rgba.size() % 4 == 0 && texels % t.width == 0 && texels / t.width == t.height, what,
            "holds " + std::to_string(t.rgba.size()) + " bytes instead of width × height × 4");
}

void checkTogether(const Material& m, const std::string& what) {
    if (m.kind == MaterialKind::Phong || m.kind == MaterialKind::Mirror)
        require(unitInterval.holds(m.specular), what, "specular lies outside [0,1]");
    if (m.kind == MaterialKind::Phong) {
        // One rounding of the sum is forgiven: .3 + .7 must pass.
        require(maxComponent(m.baseColor + m.specular) <= 1.000001f, what,
                "diffuse and specular reflectance add up to more than 1");
    }
}

// Beyond, differences of coordinates overflow; scenes that are smaller have lengths that are no longer normal floats.
constexpr Range near{-1e30f, 1e30f,
                     "reaches further than 1e30 units from the origin, more than single precision holds"};
constexpr double smallestRadius = 1e-30;
constexpr float narrowestSpot = 1e-6f;

void checkTogether(const Mesh& mesh, const std::string& what) {
    require(!mesh.triangles.empty(), what, "has no triangles");
    for (const Vec3f& p : mesh.positions) require(near.holds(p), what, near.otherwise);
}

void checkTogether(const Sphere& sphere, const std::string& what) {
    require(near.holds(sphere.center) && near.holds(sphere.radius), what, near.otherwise);
}

void checkTogether(const SpotLight& light, const std::string& what) {
    require(light.innerHalfAngle >= 0 && light.innerHalfAngle < light.outerHalfAngle &&
                light.outerHalfAngle <= std::numbers::pi_v<float>,
            what, "half-angles must satisfy 0 ≤ inner < outer ≤ 180°");
    require(light.outerHalfAngle >= narrowestSpot, what,
            "outer half-angle is below 1e-6 radians, narrower than single precision's directions");
}

void checkTogether(const Environment& e, const std::string& what) {
    require(e.map.size() == size_t(e.width) * e.height && (e.width == 0) == (e.height == 0), what,
            "map does not hold width × height values");
}

void checkTogether(const Camera& c, const std::string& what) {
    require(length(cross(Vec3d(c.forward), Vec3d(c.up))) > 1e-4, what, "up is parallel to the viewing direction");
    require(c.orthographicHeight == 0 || c.lensRadius == 0, what, "a parallel projection has no lens");
}

/// "point light #0", "material 'floor'", and of what there is one only "camera".
template <class S>
std::string label(const char* field, bool listed, size_t index, const S& object) {
    std::string text = field;
    std::replace(text.begin(), text.end(), '_', ' ');
    if constexpr (requires { object.name; })
        if (!object.name.empty()) return text + " '" + object.name + "'";
    return listed ? text + " #" + std::to_string(index) : text;
}

}  // namespace

void validate(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) checkMesh(mesh);  // names the vertex
    forEachField(scene, [&](auto field, const auto& parts) {
        if constexpr (HasFields<Entry<decltype(parts)>>) {
            size_t index = 0;
            forEachEntry(parts, [&](const auto& part) {
                const bool listed = isList<std::remove_cvref_t<decltype(parts)>>;
                const std::string what = label(field.name, listed, index++, part);
                checkFields(part, what, scene);
                checkTogether(part, what);
            });
        }
    });
    for (const Mesh& mesh : scene.meshes)
        require(!scene.materials[mesh.material].scattersInside() || isClosed(mesh), "mesh '" + mesh.name + "'",
                "is open, but its material '" + scene.materials[mesh.material].name +
                    "' scatters light inside (scattering_distance); close it");
    const std::string what = "scene '" + scene.name + "'";
    require(!scene.meshes.empty() || !scene.spheres.empty(), what, "holds no surface");
    require(boundingRadius(scene) >= smallestRadius, what,
            "is smaller than 1e-30 units, less than single precision holds");
    require(scene.imageWidth > 0 && scene.imageHeight > 0, "image", "width and height must be at least 1");
    require(!scene.maxPathLength || (*scene.maxPathLength > 0 && *scene.maxPathLength <= SettingsLimits::pathLength),
            what, "max_path_length must be between 1 and " + std::to_string(SettingsLimits::pathLength));
    require(hasLight(scene), what, "holds no light: nothing in it emits");
}

}  // namespace antipode
