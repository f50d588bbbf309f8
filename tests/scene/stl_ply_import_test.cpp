// Formats without materials and up axis.
#include <string>

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

}  // namespace
}  // namespace antipode
