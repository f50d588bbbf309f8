// After a failed load the next load gives exactly its own scene, as a fresh process does.
#include <gtest/gtest.h>

#include <filesystem>

#include "proto/scene_loader.h"
#include "renderengine/error.h"
#include "support/hard_case.h"
#include "tests/inputs/child_process.h"
#include "tests/inputs/mutations.h"
#include "tests/inputs/pictures.h"
#include "tests/scene/model_files.h"

namespace antipode::test {
namespace {

class Recovery : public testing::ModelFiles {};

TEST_F(Recovery, NeverThePreviousScene) {
    const testing::TriangleGltf triangle;
    const Bytes glb = triangle.glb(), png = makePng(pngKinds()[8]);
    write("t.png", png);
    const std::string textured =
        "texture { name: \"t\" file: \"t.png\" }\n"
        "material { name: \"m\" base_color_texture: \"t\" }\n"
        "sphere { radius: 2 material: \"m\" }\n"
        "point_light { position: [0, 5, 0] intensity: [1, 1, 1] }\n";
    const std::vector<std::string> good = {write("a.glb", glb), write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                                           write("c.textproto", textured),
                                           write("d.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n")};
    write("cut.png", Bytes(png.begin(), png.begin() + 60));
    const std::vector<std::string> bad = {
        write("a2.glb", Bytes(glb.begin(), glb.begin() + std::ptrdiff_t(glb.size() / 2))),
        write("b2.obj", "v 0 0 0\nf 1 2 3\n"),
        write("c2.textproto", textured + "quad {"),
        write("d2.textproto", textured + "texture { name: \"u\" file: \"cut.png\" }"),
        write("e2.textproto", textured + "model { file: \"a2.glb\" }"),
        write("f2.raw", "0 0 0 0 1 0 1 0 0 a.png\n\nsecond\n0 0 0 0 1 0 1 0 0 b.png\n"),
        (directory_ / "missing.gltf").string()};

    std::vector<std::string> fresh;
    for (const std::string& path : good) {
        const Outcome outcome = loadInChild(path);
        ASSERT_EQ(outcome.ending, Ending::Returned) << path << outcome;
        fresh.push_back(outcome.text);
    }
    for (const std::string& failing : bad) {
        for (size_t i = 0; i < good.size(); ++i) {
            EXPECT_THROW(loadScene(failing), Error) << failing;
            SCOPED_TRACE(good[i] + " after " + failing);
            expectWithin(
                {"Bad input", "a sound file after a broken one", "scenes that are not those of a fresh process", 0},
                checkedHash(loadScene(good[i])) != fresh[i]);
        }
    }
}

/// The same path, first sound, then broken, then sound again with other content.
TEST_F(Recovery, NothingIsRememberedByName) {
    const std::string path = write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string first = checkedHash(loadScene(path));
    write("m.obj", "v 0 0 0\n");
    EXPECT_THROW(loadScene(path), Error);
    write("m.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_NE(checkedHash(loadScene(path)), first);
    EXPECT_EQ(checkedHash(loadScene(path)), loadInChild(path).text);
}

}  // namespace
}  // namespace antipode::test
