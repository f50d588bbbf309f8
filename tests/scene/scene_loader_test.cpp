#include "proto/scene_loader.h"

#include <numbers>

#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::inputErrorOf;

const std::string kLight = "point_light { position: [0, 5, 0] intensity: [1, 1, 1] }\n";
const std::string kBall = "material { name: \"m\" }\nsphere { radius: 1 material: \"m\" }\n";

Scene parse(const std::string& text) { return parseScene(text, "t.textproto", "."); }
std::string errorOf(const std::string& text) {
    return inputErrorOf([&] { parse(text); });
}

TEST(SceneLoader, SyntaxErrorsHaveFileLineAndColumn) {
    EXPECT_EQ(errorOf("name: \"x\"\nsphere { radios: 1 }\n").rfind("t.textproto:2:", 0), 0u)
        << errorOf("name: \"x\"\nsphere { radios: 1 }\n");
    EXPECT_EQ(errorOf("camera {\n  lens_radius: \"wide\"\n}").rfind("t.textproto:2:16", 0), 0u);
    EXPECT_EQ(errorOf("sphere {").rfind("t.textproto:", 0), 0u);
}

struct Mistake {
    const char* name;
    std::string text, named;
};

class SceneMistakes : public ::testing::TestWithParam<Mistake> {};

TEST_P(SceneMistakes, AreNamed) {
    const std::string message = errorOf(GetParam().text);
    EXPECT_EQ(message.rfind("t.textproto: ", 0), 0u) << message;
    EXPECT_NE(message.find(GetParam().named), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneMistakes,
    ::testing::Values(
        Mistake{"UnknownMaterial", kLight + "sphere { radius: 1 material: \"gold\" }", "'gold', which does not exist"},
        Mistake{"NoMaterial", kLight + "sphere { radius: 1 }", "sphere #0: material names no material"},
        Mistake{"AmbiguousMaterial",
                kLight + "material { name: \"m\" } material { name: \"m\" } sphere { radius: 1 material: \"m\" }",
                "more than one"},
        Mistake{"IndexPastEnd", kLight + "material {} sphere { radius: 1 material: \"#1\" }", "'#1'"},
        Mistake{"TwoNumbers", kLight + kBall + "camera { position: [1, 2] }",
                "camera: position needs three numbers, not 2"},
        Mistake{"TwoAngles", kLight + kBall + "camera { position: [0, 0, 5] focal_length: 50 vertical_fov: 30 }",
                "camera needs either focal_length or vertical_fov"},
        Mistake{"TwoLenses", kLight + kBall + "camera { position: [0, 0, 5] f_stop: 2 lens_radius: 0.1 }",
                "either f_stop or lens_radius"},
        Mistake{"NoFocalLength", kLight + kBall + "camera { position: [0, 0, 5] focal_length: 0 }",
                "camera: focal_length"},
        Mistake{"NegativeStop", kLight + kBall + "camera { position: [0, 0, 5] f_stop: -2 }", "camera: f_stop"},
        Mistake{"NoSensor", kLight + kBall + "camera { position: [0, 0, 5] sensor_width: nan }",
                "camera: sensor_width"},
        Mistake{"LookAtItself", kLight + kBall + "camera { position: [1, 2, 3] look_at: [1, 2, 3] }",
                "camera: look_at"},
        Mistake{"ZeroDirection", kBall + "directional_light { direction: [0, 0, 0] irradiance: [1, 1, 1] }",
                "directional_light #0: direction"},
        Mistake{"MissingTextureFile", kLight + "texture { name: \"t\" file: \"gone.png\" }" + kBall, "gone.png"},
        Mistake{"MissingModel", kLight + kBall + "model { file: \"gone.obj\" }", "gone.obj"},
        Mistake{"MissingMap", kBall + "environment { file: \"gone.hdr\" }", "gone.hdr"},
        Mistake{"BadIndex",
                kLight + "material {} mesh { name: \"q\" material: \"#0\" positions: [0,0,0] triangles: [0,0,1] }",
                "mesh 'q'"},
        Mistake{"NotInThrees", kLight + "material {} mesh { name: \"q\" material: \"#0\" positions: [0,0] }",
                "mesh 'q': positions"},
        Mistake{"FlatBox", kLight + "material {} box { material: \"#0\" low: [0,0,0] high: [1,0,1] }", "box: low"},
        Mistake{"NoLight", kBall, "no light"}, Mistake{"NoSurface", kLight, "no surface"},
        Mistake{"NotANumber", kLight + "material {} sphere { radius: nan material: \"#0\" }", "sphere #0"}),
    [](const auto& instance) { return instance.param.name; });

TEST(SceneLoader, DegreesBecomeRadians) {
    const Scene scene = parse(kBall +
                              "camera { position: [0, 0, 5] look_at: [0, 0, 0] vertical_fov: 60 lens_radius: 0.1 }"
                              "spot_light { position: [0, 3, 0] direction: [0, -2, 0] intensity: [1, 2, 3] "
                              "inner_half_angle: 10 outer_half_angle: 20 }"
                              "environment { radiance: [1, 1, 1] rotation: 90 z_up: true }");
    EXPECT_FLOAT_EQ(scene.camera.verticalFov, std::numbers::pi_v<float> / 3);
    EXPECT_EQ(scene.camera.forward, Vec3f(0, 0, -1));
    EXPECT_EQ(scene.camera.focusDistance, 5);
    EXPECT_EQ(scene.spotLights[0].direction, Vec3f(0, -1, 0));
    EXPECT_FLOAT_EQ(scene.spotLights[0].outerHalfAngle, std::numbers::pi_v<float> / 9);
    EXPECT_FLOAT_EQ(scene.environment->rotation, std::numbers::pi_v<float> / 2);
    EXPECT_TRUE(scene.environment->zUp);
}

/// 24 mm of a sensor's height at 50 mm are 2·atan(12/50) = 26.991°; f/2 is a hole 25 mm wide.
TEST(SceneLoader, LensesAreGivenAsPhotographersDo) {
    const auto camera = [](const std::string& image, const std::string& lens) {
        return parse(kLight + kBall + image + "camera { position: [0, 0, 5] " + lens + " }").camera;
    };
    const std::string threeByTwo = "image { width: 600 height: 400 }";
    EXPECT_FLOAT_EQ(camera(threeByTwo, "focal_length: 50").verticalFov, float(2 * std::atan(12.0 / 50)));
    EXPECT_EQ(camera(threeByTwo, "focal_length: 50").lensRadius, 0);
    EXPECT_FLOAT_EQ(camera("", "focal_length: 50").verticalFov, float(2 * std::atan(18.0 / 50)));
    EXPECT_FLOAT_EQ(camera(threeByTwo, "focal_length: 25 sensor_width: 18").verticalFov,
                    float(2 * std::atan(6.0 / 25)));
    EXPECT_FLOAT_EQ(camera(threeByTwo, "focal_length: 50 f_stop: 2").lensRadius, 0.0125f);
    // 90° across 24 mm take a lens of 12 mm.
    EXPECT_FLOAT_EQ(camera(threeByTwo, "vertical_fov: 90 f_stop: 4").lensRadius, 0.0015f);
}

TEST(SceneLoader, ShapesFaceTheRightWay) {
    const Scene scene = parse(kLight +
                              "material {}\n"
                              "quad { material: \"#0\" corner: [0,0,0] edge_u: [2,0,0] edge_v: [0,3,0] }"
                              "box { material: \"#0\" low: [-1,-2,-3] high: [1,2,3] }"
                              "box { material: \"#0\" low: [-1,-2,-3] high: [1,2,3] inward: true }"
                              "disk { material: \"#0\" center: [1,1,1] normal: [0,-5,0] radius: 2 }"
                              "ripple_grid { material: \"#0\" size_x: 1 size_z: 1 cells_x: 8 cells_z: 8 wave { "
                              "amplitude: 0.02 wavelength: 0.5 direction: 30 } }");
    const auto volume = [](const Mesh& mesh) {
        double sum = 0;  // the divergence theorem: positive where fronts look outwards
        for (const auto& t : mesh.triangles)
            sum +=
                dot(Vec3d(mesh.positions[t[0]]), cross(Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]]))) / 6;
        return sum;
    };
    const auto area = [](const Mesh& mesh) {
        Vec3d sum;
        for (const auto& t : mesh.triangles)
            sum += cross(Vec3d(mesh.positions[t[1]] - mesh.positions[t[0]]),
                         Vec3d(mesh.positions[t[2]] - mesh.positions[t[0]])) *
                   0.5;
        return sum;
    };
    ASSERT_EQ(scene.meshes.size(), 5u);
    EXPECT_EQ(area(scene.meshes[0]), Vec3d(0, 0, 6));
    EXPECT_NEAR(volume(scene.meshes[1]), 48, 1e-9);
    EXPECT_NEAR(volume(scene.meshes[2]), -48, 1e-9);
    EXPECT_NEAR(area(scene.meshes[3]).y, -0.5 * 64 * 4 * std::sin(2 * std::numbers::pi / 64), 1e-4);
    EXPECT_NEAR(area(scene.meshes[4]).y, 1, 1e-6);
    // Smooth normals agree with the surface that they belong to.
    const Mesh& water = scene.meshes[4];
    for (const auto& t : water.triangles) {
        const Vec3f front = normalize(
            cross(water.positions[t[1]] - water.positions[t[0]], water.positions[t[2]] - water.positions[t[0]]));
        EXPECT_GT(dot(front, water.normals[t[0]]), 0.95f);
    }
}

TEST(SceneLoader, FieldsWithoutEffectAreNoticed) {
    const Scene scene = parse(
        kLight +
        "material { name: \"m\" roughness: 0.5 } sphere { radius: 1 material: \"m\" } camera {position: [0,0,5]}");
    ASSERT_EQ(scene.notices.size(), 1u);
    EXPECT_EQ(scene.notices[0], "Material 'm': roughness has no effect on LAMBERT.");
}

class SceneLoaderFiles : public testing::ModelFiles {};

TEST_F(SceneLoaderFiles, ModelWithTransformAndOverride) {
    write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
    write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n");
    const std::string path = write(
        "s.textproto", kLight +
                           "camera { position: [0, 0, 9] } material { name: \"mine\" base_color: [0, 0, 1] }\n"
                           "model { file: \"m.obj\" override { replace: \"b\" material: \"mine\" }\n"
                           "  transform { scale: [2] rotate { axis: [0, 0, 3] degrees: 90 } translate: [0, 0, 5] } }");
    const Scene scene = loadScene(path);
    EXPECT_EQ(scene.name, "s");
    ASSERT_EQ(scene.meshes.size(), 2u);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[scene.meshes[0].material].baseColor, Vec3f(1, 0, 0));
    EXPECT_EQ(scene.materials[scene.meshes[1].material].baseColor, Vec3f(0, 0, 1));
    // (1,0,0) → (2,0,0) → (0,2,0) → (0,2,5).
    const Vec3f& p = scene.meshes[0].positions[1];
    EXPECT_NEAR(p.x, 0, 1e-6);
    EXPECT_NEAR(p.y, 2, 1e-6);
    EXPECT_NEAR(p.z, 5, 1e-6);
}

TEST_F(SceneLoaderFiles, TextureFile) {
    write("two.png", testing::makePng());
    const Scene scene = loadScene(write(
        "s.textproto", kLight +
                           "texture { name: \"t\" file: \"two.png\" linear: true wrap_u: CLAMP }\n"
                           "material { name: \"m\" base_color_texture: \"t\" } sphere { radius: 1 material: \"m\" }"));
    EXPECT_EQ(scene.textures.at(0).rgba.size(), 8u);
    EXPECT_FALSE(scene.textures[0].srgb);
    EXPECT_EQ(scene.textures[0].wrapU, WrapMode::Clamp);
    EXPECT_EQ(scene.materials[0].baseColorTexture, TextureIndex(0));
}

TEST_F(SceneLoaderFiles, OtherExtensionsAreImported) {
    EXPECT_EQ(loadScene(write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).meshes.size(), 1u);
    inputErrorOf([&] { loadScene("missing.textproto"); });
}

}  // namespace
}  // namespace antipode
