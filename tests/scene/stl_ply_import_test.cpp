// Formats without materials and up axis.
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "renderengine/error.h"
#include "renderengine/import_options.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

constexpr const char* kStl =
    "solid t\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "endsolid t\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n";

class BareFormats : public testing::ModelFiles {};

TEST_F(BareFormats, AreGrey) {
    for (const std::string& path : {write("t.stl", kStl), write("t.ply", kPly)}) {
        const Scene scene = importModel(path);
        ASSERT_EQ(scene.materials.size(), 1u);
        EXPECT_EQ(scene.materials[0].kind, MaterialKind::Lambert) << path;
        EXPECT_EQ(scene.materials[0].baseColor, Vec3f(0.6f)) << path;
    }
}

TEST_F(BareFormats, StlStandsOnZ) {
    const auto highest = [](const Scene& scene) {
        float y = 0;
        for (const Vec3f& p : scene.meshes.at(0).positions) y = std::max(y, p.y);
        return y;
    };
    const std::string stl = write("t.stl", kStl), ply = write("t.ply", kPly);
    EXPECT_EQ(highest(importModel(stl)), 1.0f);
    EXPECT_EQ(highest(importModel(ply)), 0.0f);
    ImportOptions options;
    options.up = UpAxis::Y;
    EXPECT_EQ(highest(importModel(stl, options)), 0.0f);
    options.up = UpAxis::Z;
    EXPECT_EQ(highest(importModel(ply, options)), 1.0f);
}

TEST_F(BareFormats, PlyShowsItsVertexColours) {
    const Scene scene = importModel(
        write("t.ply",
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
              "property uchar red\nproperty uchar green\nproperty uchar blue\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "0 0 0 255 0 0\n1 0 0 0 188 0\n0 0 1 0 0 255\n3 0 1 2\n"));
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.colors.size(), 3u);
    for (size_t i = 0; i < 3; ++i)
        if (mesh.positions[i].x == 1)
            EXPECT_NEAR(mesh.colors[i][1], 0.5029f, 1e-3) << "188 of sRGB";
        else
            EXPECT_EQ(mesh.colors[i][1], 0.0f);
    EXPECT_EQ(scene.materials[mesh.material].baseColor, Vec3f(1.0f)) << "not times the grey of what has no colour";
    for (const std::string& notice : scene.notices) EXPECT_EQ(notice.find("colour"), std::string::npos) << notice;
}

/// Two strips, parted by -1: of three triangles in a zigzag, and of one; then one that only leads on.
const std::vector<int> zigzag{0, 1, 2, 3, 4, -1, 0, 1, 3, 3};

void expectTheZigzag(const Scene& scene) {
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.triangles.size(), 4u);
    double area = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
        EXPECT_GT(cross(b - a, c - a).z, 0) << "every second one is turned round";
        area += cross(b - a, c - a).z / 2;
    }
    EXPECT_EQ(area, 2);
}

std::string zigzagHeader(const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
}

TEST_F(BareFormats, PlyStripsAreTriangles) {
    ImportOptions upright;
    upright.up = UpAxis::Y;
    std::string text = zigzagHeader("ascii") + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n" + std::to_string(zigzag.size());
    for (const int vertex : zigzag) text += " " + std::to_string(vertex);
    expectTheZigzag(importModel(write("s.ply", text + "\n"), upright));
}

TEST_F(BareFormats, PlyStripsAreTrianglesInEitherByteOrder) {
    ImportOptions upright;
    upright.up = UpAxis::Y;
    for (const bool little : {true, false}) {
        std::string text = zigzagHeader(little ? "binary_little_endian" : "binary_big_endian");
        const auto add = [&](uint32_t bits) {
            for (int i = 0; i < 4; ++i) text += char(bits >> 8 * (little ? i : 3 - i));
        };
        for (const float x : {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}) add(std::bit_cast<uint32_t>(x));
        add(uint32_t(zigzag.size()));
        for (const int vertex : zigzag) add(uint32_t(vertex));
        expectTheZigzag(importModel(write("s.ply", text), upright));
        text.resize(text.size() - 3);
        try {
            importModel(write("cut.ply", text), upright);
            FAIL() << "a cut file was taken";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("the file ends too early"), std::string::npos) << error.what();
        }
    }
}

TEST_F(BareFormats, NormalsThatAreNoNumbersAreReplaced) {
    const Scene scene = importModel(
        write("n.ply",
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
              "property float nx\nproperty float ny\nproperty float nz\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "0 0 0 nan nan nan\n1 0 0 0.6 0 0.8\n0 1 0 0 0 1\n3 0 1 2\n"));
    ASSERT_EQ(scene.meshes.at(0).normals.size(), 3u);
    EXPECT_EQ(scene.meshes[0].normals[0], Vec3f(0, 0, 1)) << "the triangle's own";
    const auto said = [](const std::string& n) { return n.find("1 normals are not finite") != n.npos; };
    EXPECT_EQ(std::count_if(scene.notices.begin(), scene.notices.end(), said), 1);
}

}  // namespace
}  // namespace antipode
