#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "support/hard_case.h"
#include "tests/scene/full_scene.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::inputErrorOf;
using testing::smallScene;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Validate, AcceptsAValidScene) { EXPECT_NO_THROW(validate(smallScene())); }

struct BadScene {
    const char* name;
    std::function<void(Scene&)> spoil;
    const char* named;  ///< what the message must mention
};

class ValidateRejects : public ::testing::TestWithParam<BadScene> {};

TEST_P(ValidateRejects, AndNamesTheObject) {
    Scene scene = smallScene();
    GetParam().spoil(scene);
    const std::string message = inputErrorOf([&] { validate(scene); });
    SCOPED_TRACE(message);
    expectWithin({"Bad input", "NaN vertices, indices out of range, empty meshes, no light, no surface, bad cameras",
                  "scenes that are taken, or refused without naming the object", 0},
                 message.find(GetParam().named) == std::string::npos);
}

const BadScene kBadScenes[] = {
    {"NanPosition", [](Scene& s) { s.meshes[0].positions[1].y = kNan; }, "mesh 'triangle': position 1"},
    {"InfinitePosition", [](Scene& s) { s.meshes[0].positions[2].x = kInf; }, "mesh 'triangle': position 2"},
    {"IndexOutOfRange", [](Scene& s) { s.meshes[0].triangles[0][2] = 3; }, "vertex 3 of 3"},
    {"EmptyMesh", [](Scene& s) { s.meshes[0].triangles.clear(); }, "mesh 'triangle': has no triangles"},
    {"WrongNormalCount",
     [](Scene& s) {
         s.meshes[0].normals = {{0, 0, 1}};
     },
     "1 normals for 3"},
    {"WrongUvCount",
     [](Scene& s) {
         s.meshes[0].uvs = {{0, 0}};
     },
     "1 uvs for 3"},
    {"LongNormal",
     [](Scene& s) {
         s.meshes[0].normals.assign(3, {0, 0, 2});
     },
     "unit length"},
    {"MeshMaterial", [](Scene& s) { s.meshes[0].material = 2; }, "material that does not exist"},
    {"OpenMilk",
     [](Scene& s) {
         s.materials[1].kind = MaterialKind::Dielectric;
         s.materials[1].scatteringDistance = 1.0f;
     },
     "mesh 'triangle': is open, but its material 'lamp' scatters"},
    {"Anisotropy", [](Scene& s) { s.materials[0].scatteringAnisotropy = -1; },
     "material 'grey': scattering_anisotropy lies outside [-0.999, 0.999]"},
    {"SphereMaterial", [](Scene& s) { s.spheres[0].material = 9; }, "sphere #0"},
    {"NegativeRadius", [](Scene& s) { s.spheres[0].radius = -1; }, "sphere #0"},
    {"NanRadius", [](Scene& s) { s.spheres[0].radius = kNan; }, "sphere #0"},
    {"FarMesh", [](Scene& s) { s.meshes[0].positions[1].y = -2e30f; }, "mesh 'triangle': reaches further"},
    {"FarSphere", [](Scene& s) { s.spheres[0].center.z = 2e30f; }, "sphere #0: reaches further"},
    {"TinyScene",
     [](Scene& s) {
         for (Vec3f& p : s.meshes[0].positions) p *= 1e-32f;
         s.spheres[0] = {{0, 0, 0}, 1e-32f, 0};
     },
     "smaller than 1e-30"},
    {"BrightBaseColor", [](Scene& s) { s.materials[0].baseColor.x = 1.5f; }, "material 'grey'"},
    {"NegativeEmission", [](Scene& s) { s.materials[1].emission.z = -1; }, "material 'lamp'"},
    {"InfiniteEmission", [](Scene& s) { s.materials[1].emission.z = kInf; }, "material 'lamp'"},
    {"LowIor", [](Scene& s) { s.materials[0].ior = 0.9f; }, "ior is below 1"},
    {"LowAbbeNumber", [](Scene& s) { s.materials[0].abbeNumber = 0.9f; }, "abbe_number is below 1"},
    {"NanRoughness", [](Scene& s) { s.materials[0].roughness = kNan; }, "roughness"},
    {"MissingTexture", [](Scene& s) { s.materials[0].baseColorTexture = 0; }, "texture that does not exist"},
    {"PhongCreatesLight", [](Scene& s) { s.materials[0].kind = MaterialKind::Phong; }, "more than 1"},
    {"TextureSize",
     [](Scene& s) {
         s.textures.push_back({"t", 2, 2, std::vector<uint8_t>(15)});
     },
     "texture 't'"},
    {"PointLightNan",
     [](Scene& s) {
         s.pointLights.push_back({{kNan, 0, 0}, {1, 1, 1}});
     },
     "point light #0"},
    {"NarrowSpot",
     [](Scene& s) {
         s.spotLights.push_back({{0, 0, 0}, {0, 0, 1}, {1, 1, 1}, 0, 1e-7f});
     },
     "spot light #0: outer half-angle"},
    {"SpotAngles",
     [](Scene& s) {
         s.spotLights.push_back({{}, {0, 0, 1}, {1, 1, 1}, 0.5f, 0.5f});
     },
     "spot light #0"},
    {"SunDirection",
     [](Scene& s) {
         s.directionalLights.push_back({{0, 0, 0}, {1, 1, 1}});
     },
     "directional light #0"},
    {"EnvironmentSize", [](Scene& s) { s.environment.emplace().width = 2; }, "environment"},
    {"CameraFov", [](Scene& s) { s.camera.verticalFov = 3.2f; }, "camera"},
    {"CameraUp",
     [](Scene& s) {
         s.camera.up = {0, 0, 1};
     },
     "parallel"},
    {"CameraFocus", [](Scene& s) { s.camera.focusDistance = 0; }, "focus"},
    {"NoPixels", [](Scene& s) { s.imageHeight = 0; }, "image"},
    {"NoEdges", [](Scene& s) { s.maxPathLength = 0; }, "max_path_length"},
    {"TooManyEdges", [](Scene& s) { s.maxPathLength = 65536; }, "between 1 and 65535"},
    {"NoSurface", [](Scene& s) { s.meshes.clear(), s.spheres.clear(); }, "no surface"},
    {"NoLight", [](Scene& s) { s.materials[1].emission = {}; }, "no light"},
    {"UnusedLamp", [](Scene& s) { s.meshes[0].material = 0; }, "no light"},
    {"BlackSky", [](Scene& s) { s.meshes[0].material = 0, s.environment.emplace(); }, "no light"},
};
INSTANTIATE_TEST_SUITE_P(All, ValidateRejects, ::testing::ValuesIn(kBadScenes),
                         [](const auto& instance) { return instance.param.name; });

TEST(Validate, AnyKindOfLightIsEnough) {
    const std::function<void(Scene&)> lights[] = {
        [](Scene& s) {
            s.pointLights.push_back({{}, {0, 0, 1}});
        },
        [](Scene& s) {
            s.spotLights.push_back({{}, {0, 0, 1}, {1, 0, 0}});
        },
        [](Scene& s) {
            s.directionalLights.push_back({{0, 0, 1}, {1, 0, 0}});
        },
        [](Scene& s) {
            s.environment.emplace().radiance = {0, 1, 0};
        },
    };
    for (const auto& add : lights) {
        Scene scene = smallScene();
        scene.meshes[0].material = 0;
        add(scene);
        EXPECT_NO_THROW(validate(scene));
    }
}

}  // namespace
}  // namespace antipode
