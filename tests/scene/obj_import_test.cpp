// Wavefront OBJ and MTL through importModel().
#include <string>

#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::inputErrorOf;

class ObjImport : public testing::ModelFiles {
protected:
    /// One triangle of one material.
    Scene withMaterial(const std::string& mtl) {
        write("m.mtl", "newmtl m\n" + mtl);
        return importModel(write("m.obj", "mtllib m.mtl\no tri\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"));
    }
    Material material(const std::string& mtl) {
        const Scene scene = withMaterial(mtl);
        EXPECT_EQ(scene.materials.size(), 1u) << "Assimp's default material must not be kept";
        return scene.materials.at(0);
    }
};

TEST_F(ObjImport, Lambert) {
    const Material m = material("Kd 0.1 0.2 0.3\nKs 0 0 0\nillum 2\n");
    EXPECT_EQ(m.kind, MaterialKind::Lambert);
    EXPECT_EQ(m.baseColor, Vec3f(0.1f, 0.2f, 0.3f));
    EXPECT_TRUE(m.twoSided);
    EXPECT_FALSE(m.emits());
}

TEST_F(ObjImport, PhongKeepsItsExponent) {
    const Material m = material("Kd 0.1 0.1 0.1\nKs 0.7 0.6 0.5\nNs 90\nillum 2\n");
    EXPECT_EQ(m.kind, MaterialKind::Phong);
    EXPECT_EQ(m.specular, Vec3f(0.7f, 0.6f, 0.5f));
    EXPECT_EQ(m.phongExponent, 90.0f);
}

TEST_F(ObjImport, PhongThatCreatesLightIsScaledWithANotice) {
    const Scene scene = withMaterial("Kd 1 1 1\nKs 1 1 1\nNs 10\nillum 2\n");
    EXPECT_EQ(scene.materials[0].baseColor, Vec3f(0.5f));
    EXPECT_EQ(scene.materials[0].specular, Vec3f(0.5f));
    EXPECT_NE(scene.notices.at(0).find("'m'"), std::string::npos);
}

TEST_F(ObjImport, IlluminationOneHasNoHighlight) {
    EXPECT_EQ(material("Kd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nillum 1\n").kind, MaterialKind::Lambert);
}

TEST_F(ObjImport, Mirror) {
    const Material m = material("Kd 0 0 0\nKs 0.9 0.9 0.8\nillum 3\n");
    EXPECT_EQ(m.kind, MaterialKind::Mirror);
    EXPECT_EQ(m.specular, Vec3f(0.9f, 0.9f, 0.8f));
}

TEST_F(ObjImport, GlassByIlluminationOrByTransparency) {
    for (const char* mtl : {"Kd 0 0 0\nNi 1.6\nillum 7\n", "Kd 0 0 0\nNi 1.6\nd 0.1\nillum 2\n"}) {
        const Material m = material(mtl);
        EXPECT_EQ(m.kind, MaterialKind::Dielectric) << mtl;
        EXPECT_EQ(m.ior, 1.6f) << mtl;
    }
}

TEST_F(ObjImport, EmissionMayExceedOne) { EXPECT_EQ(material("Kd 0 0 0\nKe 17 12 4\n").emission, Vec3f(17, 12, 4)); }

TEST_F(ObjImport, AddsCameraAndLightWithNotices) {
    const Scene scene = withMaterial("Kd 0.5 0.5 0.5\n");
    ASSERT_TRUE(scene.environment.has_value());
    ASSERT_EQ(scene.notices.size(), 2u);
    EXPECT_NE(scene.notices[0].find("camera"), std::string::npos);
    EXPECT_NE(scene.notices[1].find("light"), std::string::npos);
    // All vertices lie inside the cone of view.
    for (const Vec3f& p : scene.meshes[0].positions) {
        const Vec3d towards = normalize(Vec3d(p - scene.camera.position));
        EXPECT_GT(dot(towards, Vec3d(scene.camera.forward)), std::cos(scene.camera.verticalFov / 2));
    }
}

TEST_F(ObjImport, NormalsOnlyWhereTheFileHasThem) {
    EXPECT_TRUE(withMaterial("Kd 1 1 1\n").meshes[0].normals.empty());
    const Scene smooth =
        importModel(write("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 0 1 1\nf 1//1 2//2 3//1\n"));
    ASSERT_EQ(smooth.meshes[0].normals.size(), 3u);
    EXPECT_EQ(smooth.meshes[0].normals[0], Vec3f(0, 0, 1));
}

TEST_F(ObjImport, PolygonsAreTriangulatedAndDegeneratesCounted) {
    const Scene scene =
        importModel(write("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 1 2 5\nf 1 1 2\n"));
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
    EXPECT_NE(scene.notices.at(0).find("2 triangles without area"), std::string::npos) << scene.notices[0];
}

TEST_F(ObjImport, TextureRowsRunWithV) {
    write("two.png", testing::makePng());
    write("t.mtl", "newmtl m\nKd 1 1 1\nmap_Kd two.png\n");
    const Scene scene = importModel(
        write("t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"));
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_TRUE(scene.textures[0].srgb);
    EXPECT_EQ(scene.materials[0].baseColorTexture, TextureIndex(0));
    // OBJ's v = 0 is the image's last row, the engine's the first.
    const auto& mesh = scene.meshes[0];
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(mesh.uvs[i][1], 1 - mesh.positions[i].y);
}

TEST_F(ObjImport, NonFiniteVertexIsNamed) {
    const std::string message =
        inputErrorOf([&] { importModel(write("nan.obj", "o broken\nv nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")); });
    EXPECT_NE(message.find("nan.obj"), std::string::npos) << message;
}

TEST_F(ObjImport, BadIndexEmptyAndMissingFilesAreErrors) {
    inputErrorOf([&] { importModel(write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")); });
    inputErrorOf([&] { importModel(write("empty.obj", "")); });
    inputErrorOf([&] { importModel(write("points.obj", "v 0 0 0\nv 1 0 0\n")); });
    EXPECT_NE(inputErrorOf([&] { importModel("no/such.obj"); }).find("no/such.obj"), std::string::npos);
    inputErrorOf([&] { importModel(write("what.xyz", "hello")); });
}

}  // namespace
}  // namespace antipode
