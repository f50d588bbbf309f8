// The scene in physical units: what importers and the scene schema produce, and what the engine renders.
// Lengths are in scene units, angles in radians, radiance in W/(m² sr), all colours linear RGB (Rec. 709 primaries).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderengine/vec.h"

namespace antipode {

enum class WrapMode { Repeat, Mirror, Clamp };

/// An 8-bit RGBA image in texture space: texel (0,0) is at uv = (0,0); rows go with growing v.
struct Texture {
    std::string name;
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgba;  ///< width·height·4 bytes
    bool srgb = true;           ///< RGB is sRGB-encoded (colours); false for data such as normals and roughness
    WrapMode wrapU = WrapMode::Repeat, wrapV = WrapMode::Repeat;
    bool nearest = false;  ///< the nearest texel, not a mixture of four
    uint32_t uvSet = 0;    ///< of a mesh's sets of texture coordinates the one that it is looked up with
};

using TextureIndex = std::optional<uint32_t>;

enum class MaterialKind {
    Lambert,            ///< baseColor = diffuse reflectance
    Phong,              ///< modified Phong (Lafortune & Willems 1994): baseColor diffuse, specular, phongExponent
    Mirror,             ///< perfect mirror of reflectance `specular`
    Dielectric,         ///< smooth interface of index `ior`, unpolarised Fresnel
    RoughConductor,     ///< GGX of width `roughness`², complex index eta + i·k per channel
    RoughDielectric,    ///< GGX of width `roughness`², index `ior` (Walter et al. 2007)
    MetallicRoughness,  ///< glTF 2.0 core model, with KHR_materials_clearcoat, _dispersion, _ior, _sheen, _specular,
                        ///< _transmission, _volume
};

struct Material {
    std::string name;
    MaterialKind kind = MaterialKind::Lambert;
    Vec3f baseColor{0.8f};        ///< in [0,1]; multiplied by baseColorTexture
    Vec3f specular{1.0f};         ///< Phong and Mirror: specular reflectance; MetallicRoughness: specular colour factor
    float specularFactor = 1.0f;  ///< MetallicRoughness: weight of the dielectric specular lobe, in [0,1]
    float phongExponent = 1.0f;   ///< ≥ 0
    float roughness = 1.0f;       ///< perceptual, in [0,1]; GGX α = roughness²; multiplied by the texture's green
    float metallic = 0.0f;        ///< in [0,1]; multiplied by the texture's blue
    float ior = 1.5f;             ///< inside over outside, ≥ 1; of the yellow line d (587.6 nm)
    /// Of transparent bodies: V = (n_d − 1)/(n_F − n_C) ≥ 1, by which the index follows Cauchy's A + B/λ². Without one
    /// it is the same at all wavelengths.
    std::optional<float> abbeNumber;
    Vec3f conductorEta{0.2f, 0.92f, 1.1f};
    Vec3f conductorK{3.9f, 2.45f, 2.14f};
    Vec3f emission{0.0f};  ///< emitted radiance, ≥ 0; multiplied by emissionTexture
    /// MetallicRoughness: share of the dielectric part that is glass instead, in [0,1]; multiplied by the texture's
    /// red. A pane's base colour tints what passes; a body's does so once for the two faces that light crosses.
    float transmission = 0.0f;
    /// MetallicRoughness, what is not glass of it: a clear coat of index 1.5 over all of that, its share in [0,1],
    /// multiplied by the texture's red, and its perceptual roughness in [0,1], by the texture's green …
    float clearcoat = 0.0f, clearcoatRoughness = 0.0f;
    /// … and sheen below it: the colour in [0,1], multiplied by the texture's, and the perceptual roughness in [0,1],
    /// by the texture's alpha; below .26 it is .26.
    Vec3f sheenColor{0.0f};
    float sheenRoughness = 0.0f;
    bool thin = false;             ///< what transmits is a pane: both its faces are here, light passes straight on
    Vec3f attenuationColor{1.0f};  ///< what is left of light in a transparent body …
    std::optional<float> attenuationDistance;  ///< … after this distance, > 0; without one nothing is absorbed
    /// A closed transparent body scatters this part of light, in [0,1], in each length of scatteringDistance > 0: per
    /// length scatteringColor/scatteringDistance. Without one it is clear. The mean cosine of the angle that light
    /// turns by, in [-.999, .999]: 0 evenly all around, > 0 on, < 0 back (Henyey and Greenstein's phase function).
    Vec3f scatteringColor{1.0f};
    std::optional<float> scatteringDistance;
    float scatteringAnisotropy = 0.0f;
    TextureIndex baseColorTexture, emissionTexture, metallicRoughnessTexture, normalTexture, transmissionTexture;
    TextureIndex clearcoatTexture, clearcoatRoughnessTexture, sheenColorTexture, sheenRoughnessTexture;
    float normalScale = 1.0f;
    std::optional<float> alphaCutoff;  ///< texels of baseColorTexture with alpha below are holes; without one it is 1
    /// Times the alpha of baseColorTexture: the part of light that meets the surface, in [0,1]. The rest passes as if
    /// it were not there. Without one all of it meets the surface; bodies of glass are not blended.
    std::optional<float> coverage;
    bool twoSided = true;         ///< false: the back face reflects nothing (transmissive kinds ignore it)
    bool emitsBothSides = false;  ///< otherwise the front face alone emits, of a sphere the outside
    uint32_t priority = 0;        ///< transmissive kinds: of overlapping bodies the greatest is the medium

    bool transmits() const {
        return kind == MaterialKind::Dielectric || kind == MaterialKind::RoughDielectric ||
               (kind == MaterialKind::MetallicRoughness && transmission > 0);
    }
    bool scattersInside() const { return transmits() && !thin && scatteringDistance && scatteringColor != Vec3f(0.0f); }
    bool emits() const { return emission.x > 0 || emission.y > 0 || emission.z > 0; }
};

/// Triangles in world space. Normals, uvs, colours and tangents are empty or have one entry per position. The front
/// face is the side from which the vertices appear counter-clockwise, or the other one where the sum of a triangle's
/// normals points there.
struct Mesh {
    std::string name;
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;  ///< unit shading normals
    std::vector<std::array<float, 2>> uvs;
    std::vector<std::array<uint32_t, 3>> triangles;
    uint32_t material = 0;
    std::vector<std::array<float, 2>> moreUvs;   ///< one per position of set 1, then of set 2 …; empty: uvs for all
    std::vector<std::array<float, 4>> colors;    ///< RGBA in [0,1], linear; multiply base colour and its alpha
    std::vector<std::array<float, 4>> tangents;  ///< of normal maps: where u grows, and the bitangent's side, ±1
};

/// An analytic sphere; its front face is the outside.
struct Sphere {
    Vec3f center;
    float radius = 1.0f;
    uint32_t material = 0;
};

struct PointLight {
    Vec3f position;
    Vec3f intensity;  ///< W/sr
};

/// Full intensity inside innerHalfAngle, falling to zero at outerHalfAngle as
/// clamp((cosθ − cos outer)/(cos inner − cos outer), 0, 1)² (KHR_lights_punctual).
struct SpotLight {
    Vec3f position;
    Vec3f direction;  ///< unit, the way the light shines
    Vec3f intensity;  ///< W/sr on the axis
    float innerHalfAngle = 0.0f, outerHalfAngle = 0.785398163f;
};

struct DirectionalLight {
    Vec3f direction;   ///< unit, the way the light travels
    Vec3f irradiance;  ///< W/m² on a plane that faces it
};

/// Radiance from infinity: constant, or an equirectangular map. Map row 0 is +Y (up); column u in [0,1) is the azimuth
/// φ = 2π(u + rotation/2π − ½) with direction (sinφ·sinθ, cosθ, −cosφ·sinθ), θ from +Y.
struct Environment {
    Vec3f radiance{0.0f};  ///< the constant, or the factor on the map
    uint32_t width = 0, height = 0;
    std::vector<Vec3f> map;  ///< width·height values, empty for a constant
    float rotation = 0.0f;   ///< radians about +Y
    bool zUp = false;        ///< the map's up axis is +Z instead of +Y
};

struct Camera {
    Vec3f position;
    Vec3f forward{0, 0, -1};           ///< unit
    Vec3f up{0, 1, 0};                 ///< unit, not parallel to forward
    float verticalFov = 0.785398163f;  ///< radians, in (0, π)
    float lensRadius = 0.0f;           ///< 0: pinhole
    float focusDistance = 1.0f;        ///< distance of the plane in focus along forward
    float orthographicHeight = 0.0f;   ///< what the image's height shows in a parallel projection; 0: perspective
};

struct Scene {
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Sphere> spheres;
    std::vector<PointLight> pointLights;
    std::vector<SpotLight> spotLights;
    std::vector<DirectionalLight> directionalLights;
    std::optional<Environment> environment;
    Camera camera;
    uint32_t imageWidth = 512, imageHeight = 512;  ///< the scene's preferred resolution
    std::optional<uint32_t> maxPathLength;         ///< edges; the scene's preferred bound, ≥ 1; unlimited without
    std::vector<std::string> notices;              ///< what the importer had to decide, one sentence each
};

/// Throws Error(Input) that names the first offending object unless every index, size, range and value is valid and
/// finite and the scene holds at least one surface and one light.
void validate(const Scene& scene);

/// Imports a mesh file (.glb .gltf .obj .dae .ply .fbx …) with its materials, lights and camera. Where the file has no
/// camera or light, sensible ones are added and said in `notices`. Throws Error(Input).
/// Other formats than glTF are read in a forked child first. The child has this thread alone: call it while no other
/// thread of the process can be holding a lock of a library that reading takes (the allocator's is safe). The client
/// imports before it starts any; where it renders frames, those of one have ended when the next is imported, and what
/// libraries keep (Embree's pool) is idle. Servers are sent scenes and never import.
Scene importModel(const std::string& path);

}  // namespace antipode
