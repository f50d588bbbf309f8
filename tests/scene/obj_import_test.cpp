// Wavefront OBJ and MTL through importModel().
#include <cmath>
#include <sstream>
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
    static std::vector<std::string> noticesWith(const Scene& scene, const std::string& word) {
        std::vector<std::string> found;
        for (const std::string& notice : scene.notices)
            if (notice.find(word) != std::string::npos) found.push_back(notice);
        return found;
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
    for (const char* mtl : {"Kd 0 0 0\nNi 1.6\nillum 7\n", "Kd 0 0 0\nNi 1.6\nd 0.1\nillum 2\n",
                            "Kd 0 0 0\nNi 1.6\nTf 1 1 1\nillum 4\n", "Kd 0 0 0\nNi 1.6\nTr 0.9\nillum 9\n"}) {
        const Material m = material(mtl);
        EXPECT_EQ(m.kind, MaterialKind::Dielectric) << mtl;
        EXPECT_EQ(m.ior, 1.6f) << mtl;
    }
}

TEST_F(ObjImport, TransmissionFilterColorsGlass) {
    const Material m = material("Kd 0.5 0.2 0.1\nTf 1 0 0\nNi 1.6\nillum 7\n");
    EXPECT_TRUE(m.transmits());
    EXPECT_EQ(m.transmission, 1.0f);
    EXPECT_EQ(m.baseColor, Vec3f(1, 0, 0));
    EXPECT_EQ(m.roughness, 0.0f);
    EXPECT_EQ(m.ior, 1.6f);
}

TEST_F(ObjImport, EmissionMayExceedOne) { EXPECT_EQ(material("Kd 0 0 0\nKe 17 12 4\n").emission, Vec3f(17, 12, 4)); }

TEST_F(ObjImport, AddsCameraAndLightWithNotices) {
    const Scene scene = withMaterial("Kd 0.5 0.5 0.5\n");
    ASSERT_TRUE(scene.environment.has_value());
    ASSERT_EQ(scene.notices.size(), 2u);
    EXPECT_NE(scene.notices[0].find("camera"), std::string::npos);
    EXPECT_NE(scene.notices[1].find("light"), std::string::npos);
    // All vertices lie inside the pyramid of view.
    const Vec3d forward(scene.camera.forward), right = normalize(cross(forward, Vec3d(scene.camera.up)));
    const double tangent = std::tan(scene.camera.verticalFov / 2.0);
    for (const Vec3f& p : scene.meshes[0].positions) {
        const Vec3d d(p - scene.camera.position);
        EXPECT_LT(std::abs(dot(d, right)), tangent * dot(d, forward));
        EXPECT_LT(std::abs(dot(d, cross(right, forward))), tangent * dot(d, forward));
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

TEST_F(ObjImport, IlluminationFiveIsNoGlass) {
    for (const char* d : {"", "d 1\n"}) {
        const Material m = material(std::string("Kd 0.8 0.1 0.1\nKs 0.5 0.5 0.5\nNs 250\nNi 1.45\nillum 5\n") + d);
        EXPECT_EQ(m.kind, MaterialKind::MetallicRoughness);
        EXPECT_EQ(m.baseColor, Vec3f(0.8f, 0.1f, 0.1f));
        EXPECT_EQ(m.metallic, 0.0f);
        EXPECT_EQ(m.ior, 1.45f);
        EXPECT_NEAR(m.roughness, std::pow(2.0 / 252, 0.25), 1e-6);
    }
}

TEST_F(ObjImport, SlightTransparencyBlends) {
    const Scene scene = withMaterial("Kd 0.8 0.1 0.1\nKs 0.5 0.5 0.5\nNs 250\nNi 1.45\nd 0.9\nillum 9\n");
    EXPECT_NE(scene.materials[0].kind, MaterialKind::Dielectric);
    EXPECT_EQ(scene.materials[0].coverage, 0.9f);
    EXPECT_TRUE(noticesWith(scene, "transparent").empty());
}

TEST_F(ObjImport, WhatTheLibraryDoesNotSayIsNotInvented) {
    write("two.png", testing::makePng());
    EXPECT_EQ(material("map_Kd two.png\n").baseColor, Vec3f(1.0f));
    const Material m = material("Ns 10\n");
    EXPECT_EQ(m.baseColor, Vec3f(0.6f)) << "our grey";
    EXPECT_EQ(m.kind, MaterialKind::Lambert) << "no Ks, no highlight";
}

TEST_F(ObjImport, PhysicallyBasedStatements) {
    const Material m = material("Kd 0.5 0.2 0.1\nPm 1\nPr 0.1\nKs 0 0 0\n");
    EXPECT_EQ(m.kind, MaterialKind::MetallicRoughness);
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 0.1f);
    EXPECT_EQ(m.specularFactor, 0.0f);
    EXPECT_EQ(material("Kd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nPr 0.3\n").specularFactor, 1.0f);
    const Scene coated = withMaterial("Kd 0.5 0.2 0.1\nPm 0\nKs 0 0 0\nPc 0.5\nPcr 0.25\n");
    EXPECT_EQ(coated.materials[0].kind, MaterialKind::MetallicRoughness) << "for its coat";
    EXPECT_EQ(coated.materials[0].clearcoat, 0.5f);
    EXPECT_EQ(coated.materials[0].clearcoatRoughness, 0.25f);
    EXPECT_TRUE(noticesWith(coated, "pc").empty());
}

TEST_F(ObjImport, HalfOfAPhysicallyBasedPairOfMaps) {
    write("two.png", testing::makePng());  // red, green: (255,0,0) (0,128,0)
    const Scene scene = withMaterial("Kd 1 1 1\nmap_Pm -imfchan g two.png\nPr 0.5\n");
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.roughness, 0.5f);
    EXPECT_EQ(m.metallic, 1.0f);
    ASSERT_TRUE(m.metallicRoughnessTexture.has_value());
    const Texture& t = scene.textures[*m.metallicRoughnessTexture];
    EXPECT_FALSE(t.srgb);
    EXPECT_EQ(t.rgba, (std::vector<uint8_t>{255, 255, 0, 255, 0, 255, 128, 255}));
}

TEST_F(ObjImport, DissolveMapMakesHoles) {
    write("two.png", testing::makePng());  // alpha 255, 64
    const Scene scene = withMaterial("Kd 0.1 0.7 0.1\nmap_d two.png\n");
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.baseColor, Vec3f(0.1f, 0.7f, 0.1f));
    ASSERT_TRUE(m.baseColorTexture.has_value());
    EXPECT_EQ(scene.textures[*m.baseColorTexture].rgba, (std::vector<uint8_t>{255, 255, 255, 255, 255, 255, 255, 64}));
    EXPECT_EQ(m.coverage, 1.0f);
    EXPECT_FALSE(m.alphaCutoff);
}

TEST_F(ObjImport, DissolveMapGoesIntoTheColorsAlpha) {
    write("two.png", testing::makePng());
    const Scene scene = withMaterial("Kd 1 1 1\nmap_Kd two.png\nmap_d -imfchan g two.png\n");
    EXPECT_EQ(scene.textures.at(0).rgba, (std::vector<uint8_t>{255, 0, 0, 0, 0, 128, 0, 128}));
}

TEST_F(ObjImport, SpecularMapCountsByItsMean) {
    write("two.png", testing::makePng());  // linear red 1 and 0, green 0 and .2158605
    const Scene scene = withMaterial("Kd 0 0 0\nKs 1 1 0.5\nNs 100\nmap_Ks two.png\n");
    EXPECT_NEAR(scene.materials[0].specular.x, 0.5, 1e-6);
    EXPECT_NEAR(scene.materials[0].specular.y, 0.1079303, 1e-6);
    EXPECT_EQ(scene.materials[0].specular.z, 0.0f);
    EXPECT_EQ(noticesWith(scene, "map_Ks").size(), 1u);
}

TEST_F(ObjImport, GreyBumpMapBecomesNormals) {
    // Two rows of heights 0, 1/2, 1, 1/2: slopes at columns 1 and 3 only.
    std::vector<uint8_t> bmp = {'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0,  40,
                                0,   0,   0, 4, 0, 0, 0, 1, 0, 0, 0,  1, 0, 24, 0};
    bmp.resize(54);
    for (uint8_t v : {0, 128, 255, 128}) bmp.insert(bmp.end(), 3, v);
    write("h.bmp", bmp);
    const Scene scene = withMaterial("Kd 1 1 1\nmap_Bump -bm 2 h.bmp\n");
    ASSERT_TRUE(scene.materials[0].normalTexture.has_value());
    const std::vector<uint8_t>& n = scene.textures[0].rgba;
    // Slope (2 − 0)/2 = 1 → normal (−1, 0, 1)/√2 → 127.5·(1 ∓ 0.7071), 127.5·1.7071.
    EXPECT_EQ(std::vector<uint8_t>(n.begin(), n.begin() + 16),
              (std::vector<uint8_t>{128, 128, 255, 255, 37, 128, 218, 255, 128, 128, 255, 255, 218, 128, 218, 255}));
}

TEST_F(ObjImport, MapOptionsMoveTheCoordinates) {
    write("two.png", testing::makePng());
    write("s.mtl", "newmtl m\nmap_Kd -clamp on -s 2 3 1 -o 0.5 0.25 two.png\n");
    const Scene scene = importModel(
        write("s.obj", "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"));
    const Mesh& mesh = scene.meshes[0];
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(mesh.uvs[i][0], mesh.positions[i].x * 2 + 0.5f);
        EXPECT_EQ(1 - mesh.uvs[i][1], mesh.positions[i].y * 3 + 0.25f);
    }
    EXPECT_EQ(scene.textures[0].wrapU, WrapMode::Clamp);
}

TEST_F(ObjImport, MissingLibrariesAndMaterialsAreNamed) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    const Scene scene = importModel(write("n.obj", "mtllib gone.mtl\n" + triangle));
    EXPECT_EQ(noticesWith(scene, "gone.mtl").size(), 1u);
    EXPECT_EQ(noticesWith(scene, "'red'").size(), 1u);
    write("n.mtl", "newmtl red\nKd 1 0 0\n");
    EXPECT_EQ(importModel(write("n.obj", "mtllib gone.mtl\n" + triangle)).materials[0].baseColor, Vec3f(1, 0, 0));
    write("with space.mtl", "newmtl red\r\nKd 0 1 0\r\n");
    EXPECT_EQ(importModel(write("n.obj", "mtllib With Space.MTL\r\n" + triangle)).materials[0].baseColor,
              Vec3f(0, 1, 0));
}

TEST_F(ObjImport, WhatIsIgnoredIsSaidOnce) {
    const Scene scene = withMaterial("Kd 0.5 0.5 0.5\nKa 1 1 1\nPc 0.5\nrefl -type sphere a.png\nwobble 3\nTf 1 0 0\n");
    for (const char* word : {"pc", "refl", "wobble"}) EXPECT_EQ(noticesWith(scene, word).size(), 1u) << word;
    EXPECT_TRUE(noticesWith(scene, "Ka").empty());
}

/// A comb of ten teeth: 38 corners, 18 of them reflex.
TEST_F(ObjImport, ConcavePolygonsKeepTheirArea) {
    std::ostringstream vertices, face;
    vertices << "v 0 0 0\nv 19 0 0\n";
    face << "f 1 2";
    int count = 2;
    const auto add = [&](int x, int y) {
        vertices << "v " << x << ' ' << 0.6 * y << ' ' << 0.8 * y << '\n';
        face << ' ' << ++count;
    };
    for (int tooth = 9; tooth >= 0; --tooth) {
        add(2 * tooth + 1, 5), add(2 * tooth, 5);
        if (tooth) add(2 * tooth, 1), add(2 * tooth - 1, 1);
    }
    const Scene scene = importModel(write("comb.obj", vertices.str() + face.str() + "\n"));
    double area = 0;
    for (const auto& t : scene.meshes.at(0).triangles) {
        const auto& p = scene.meshes[0].positions;
        area += length(cross(Vec3d(p[t[1]] - p[t[0]]), Vec3d(p[t[2]] - p[t[0]]))) / 2;
    }
    EXPECT_NEAR(area, 19 * 1 + 10 * 4, 1e-4);
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

TEST_F(ObjImport, VertexColoursAreWhatScreensShow) {
    const std::string faces = "f 1 2 3\n";
    const Mesh mesh =
        importModel(write("c.obj", "v 0 0 0 1 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 0 0 1\n" + faces)).meshes.at(0);
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_EQ(mesh.colors[0], (std::array<float, 4>{1, 0, 0, 1}));
    EXPECT_NEAR(mesh.colors[1][0], 0.2140411f, 1e-6f);
    const Scene black = importModel(write("b.obj", "v 0 0 0 0 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\n" + faces));
    EXPECT_TRUE(black.meshes.at(0).colors.empty()) << "as exporters write where there are none";
    const Scene broken = importModel(write("n.obj", "v 0 0 0 nan 0 0\nv 1 0 0 1 0 0\nv 0 1 0 0 0 1\n" + faces));
    EXPECT_TRUE(broken.meshes.at(0).colors.empty());
}

TEST_F(ObjImport, ATextureStandsForVertexColours) {
    write("t.mtl", "newmtl m\nmap_Kd t.png\n");
    write("t.png", testing::makePng());
    const Scene scene =
        importModel(write("t.obj", "mtllib t.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 0 0 1\nusemtl m\nf 1 2 3\n"));
    EXPECT_TRUE(scene.meshes.at(0).colors.empty());
    EXPECT_EQ(noticesWith(scene, "Vertex colours").size(), 1u);
}

TEST_F(ObjImport, NamesOfLibrariesMayHoldSpacesAndStandInOneLine) {
    write("a b.mtl", "newmtl m\nKd 0.1 0.1 0.1\n");
    write("c.mtl", "newmtl n\nKd 0.2 0.2 0.2\n");
    const Scene scene = importModel(write(
        "m.obj", "mtllib c.mtl a b.mtl d.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\nusemtl n\nf 3 2 1\n"));
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].baseColor.x + scene.materials[1].baseColor.x, 0.1f + 0.2f);
    const auto missing = noticesWith(scene, "missing");
    ASSERT_EQ(missing.size(), 1u);
    EXPECT_NE(missing[0].find("'d.mtl'"), std::string::npos);
}

TEST_F(ObjImport, ImagesMayLieBesideTheirLibrary) {
    std::filesystem::create_directories(directory_ / "sub/images");
    write("sub/images/t.png", testing::makePng());
    write("sub/m.mtl", "newmtl m\nmap_Kd images\\t.png \n");
    const Scene scene =
        importModel(write("m.obj", "mtllib sub\\m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"));
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].width, 2u) << "not the checker";
}

}  // namespace
}  // namespace antipode
