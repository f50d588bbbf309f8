// Scene files that nobody means well with, by name.
#include <gtest/gtest.h>

#include <filesystem>

#include <sys/stat.h>

#include "proto/scene_loader.h"
#include "support/hard_case.h"
#include "tests/inputs/child_process.h"
#include "tests/inputs/pictures.h"
#include "tests/scene/model_files.h"

namespace antipode::test {
namespace {

const std::string kLight = "point_light { position: [0, 5, 0] intensity: [1, 1, 1] }\n";
const std::string kPaint = "material { name: \"paint\" }\n";
const std::string kBall = "sphere { radius: 1 material: \"paint\" }\n";
const std::string kRest = kLight + kPaint + kBall;

std::string repeated(const std::string& text, size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    while (count-- > 0) all += text;
    return all;
}

struct HostileScene {
    const char* name;
    std::string text;
    std::vector<std::string> named;  ///< all of which the sentence holds, besides the file's name
};

class HostileScenes : public testing::ModelFiles, public ::testing::WithParamInterface<HostileScene> {};

TEST_P(HostileScenes, AreRefusedInOneClearSentence) {
    write("words.png", "these are words");
    write("empty.png", "");
    ASSERT_EQ(::mkfifo((directory_ / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("pipe", directory_ / "pipe.exr");
    std::filesystem::create_symlink("/dev/zero", directory_ / "zero.hdr");
    std::filesystem::create_symlink("/dev/zero", directory_ / "zero.obj");
    std::filesystem::create_directories(directory_ / "folder.png");
    const Outcome outcome = loadInChild(write("hostile.textproto", GetParam().text));
    bool clear = outcome.ending == Ending::InputError && objectionTo(outcome, "hostile.textproto").empty();
    for (const std::string& part : GetParam().named) clear = clear && outcome.text.find(part) != std::string::npos;
    SCOPED_TRACE(::testing::Message() << objectionTo(outcome, "hostile.textproto") << "\n" << outcome);
    expectWithin({"Bad input", "hostile scene files: counts, shapes, numbers, texts, files that never end",
                  "loads that do not end in one clear sentence that names the object", 0},
                 !clear);
}

const HostileScene kTexts[] = {
    {"Empty", "", {"no surface"}},
    {"OnlyComment", "# nothing\n", {"no surface"}},
    {"BinaryGarbage",
     "\x7f"
     "ELF\x01\x01\xff\xfe\x80 {{{",
     {}},
    {"TenMegabytesOfBraces", std::string(10 << 20, '{'), {":1:"}},
    {"TenMegabytesOfBrackets", "mesh { positions: " + std::string(10 << 20, '[') + "}", {":1:"}},
    {"TenMegabytesOfSpheresOpened", repeated("sphere{", 1 << 20), {":1:"}},
    {"TenMegabytesInOneName", "name: \"" + std::string(10 << 20, 'x') + "\"", {"no surface"}},
    {"NeverEndingString", kRest + "name: \"" + std::string(1 << 20, 'x'), {}},
    {"DeepNestingOfAnyType", kRest + repeated("[type.googleapis.com/x.Y] {", 10000), {}},
    {"UnknownField", kRest + "teapot { }", {"teapot"}},
    {"NotUtf8", kRest + "name: \"gr\xfcn\"", {"UTF-8"}},
};
const HostileScene kCounts[] = {
    {"RippleCells",
     kRest + "ripple_grid { name: \"sea\" material: \"paint\" size_x: 1 size_z: 1 cells_x: 2147483648 "
             "cells_z: 2147483648 }",
     {"ripple_grid 'sea'", "cells_x"}},
    {"RippleCellsWhoseProductIsZero",
     kRest + "ripple_grid { name: \"sea\" material: \"paint\" size_x: 1 size_z: 1 "
             "cells_x: 65536 cells_z: 65536 }",
     {"ripple_grid 'sea'", "cells_x"}},
    {"RippleWaves",
     kRest +
         "ripple_grid { name: \"sea\" material: \"paint\" size_x: 1 size_z: 1 cells_x: 8192 cells_z: "
         "8192 " +
         repeated("wave { amplitude: 1 wavelength: 1 }", 20000) + " }",
     {"ripple_grid 'sea'", "wave"}},
    {"DiskSegments",
     kRest + "disk { name: \"d\" material: \"paint\" center: [0,0,0] normal: [0,1,0] radius: 1 "
             "segments: 4294967295 }",
     {"disk 'd'", "segments"}},
    {"NegativeCells",
     kRest + "ripple_grid { name: \"sea\" material: \"paint\" size_x: 1 size_z: 1 cells_x: -1 cells_z: 1 }",
     {":4:"}},
    {"CountsBeyond32Bits", kRest + "image { width: 4294967296 height: 1 }", {":4:"}},
    {"TexelsWhoseSizeIsZeroIn64Bits",
     kRest + "texture { name: \"t\" texels { width: 2147483648 height: 2147483648 } }",
     {"texture 't'"}},
    {"TexelsThatAreMissing",
     kRest + "texture { name: \"t\" texels { width: 65536 height: 65536 rgba: \"abcd\" } }",
     {"texture 't'"}},
    {"MapThatIsMissing",
     kRest + "environment { map { width: 4294967295 height: 4294967295 rgb: [1, 2, 3] } }",
     {"environment"}},
    {"ImageOfNoPixels", kRest + "image { width: 0 height: 4294967295 }", {"image"}},
};
const HostileScene kShapes[] = {
    {"MeshIndexOutOfRange",
     kRest + "mesh { name: \"q\" material: \"paint\" positions: [0,0,0, 1,0,0, 0,1,0] triangles: "
             "[0, 1, 4294967295] }",
     {"mesh 'q'", "triangle 0", "4294967295"}},
    {"MeshWithoutTriangles", kRest + "mesh { name: \"q\" material: \"paint\" }", {"mesh 'q'", "no triangles"}},
    {"QuadWithoutArea",
     kRest + "quad { name: \"q\" material: \"paint\" corner: [0,0,0] edge_u: [1,0,0] edge_v: [2,0,0] }",
     {"quad 'q'", "no area"}},
    {"ScaleOfZero",
     kRest + "box { name: \"b\" material: \"paint\" low: [0,0,0] high: [1,1,1] transform { scale: [0] } }",
     {"box 'b'", "transform.scale"}},
    {"ScaleThatIsNone",
     kRest + "box { name: \"b\" material: \"paint\" low: [0,0,0] high: [1,1,1] transform { scale: [nan] } }",
     {"box 'b'", "transform.scale"}},
    {"RotationAboutNothing",
     kRest + "box { name: \"b\" material: \"paint\" low: [0,0,0] high: [1,1,1] transform { rotate { "
             "axis: [0,0,0] degrees: 9 } } }",
     {"box 'b'", "transform.rotate.axis"}},
    {"RotationWithoutEnd",
     kRest + "box { name: \"b\" material: \"paint\" low: [0,0,0] high: [1,1,1] transform { rotate { "
             "axis: [0,0,1] degrees: inf } } }",
     {"box 'b'", "transform.rotate.degrees"}},
    {"BoxInsideOut", kRest + "box { name: \"b\" material: \"paint\" low: [1,1,1] high: [0,0,0] }", {"box 'b'", "low"}},
    {"DiskNormalOfZero",
     kRest + "disk { name: \"d\" material: \"paint\" center: [0,0,0] normal: [0,0,0] radius: 1 }",
     {"disk 'd'", "normal"}},
    {"NegativeRadius", kLight + kPaint + "sphere { radius: -1 material: \"paint\" }", {"sphere #0", "radius"}},
    {"EndlessRadiusWithoutCamera",
     kLight + kPaint + "sphere { radius: inf material: \"paint\" }",
     {"sphere #0", "radius"}},
    {"SphereThatNoCameraFrames", kLight + kPaint + "sphere { radius: 3e38 material: \"paint\" }", {"camera"}},
    {"SpotWithoutDirection",
     kRest + "spot_light { position: [0,0,0] direction: [0,0,0] intensity: [1,1,1] }",
     {"spot_light", "direction"}},
    {"UpAlongTheView", kRest + "camera { position: [0,0,9] forward: [0,0,-1] up: [0,0,5] }", {"camera", "up"}},
};
const HostileScene kReferences[] = {
    {"MaterialTwice", kLight + repeated(kPaint, 2) + kBall, {"sphere #0", "material", "'paint'", "more than one"}},
    {"TextureTwice",
     kRest + repeated("texture { name: \"t\" texels { width: 1 height: 1 rgba: \"abcd\" } }", 2) +
         "material { name: \"m\" base_color_texture: \"t\" }",
     {"material 'm'", "base_color_texture", "more than one"}},
    {"IndexBeyond32Bits",
     kLight + kPaint + "sphere { radius: 1 material: \"#4294967296\" }",
     {"sphere #0", "#4294967296"}},
    {"NegativeIndex", kLight + kPaint + "sphere { radius: 1 material: \"#-1\" }", {"sphere #0", "#-1"}},
    {"SceneAsItsOwnModel", kRest + "model { file: \"hostile.textproto\" }", {"model", ".textproto"}},
    {"TextureOfWords", kRest + "texture { name: \"t\" file: \"words.png\" }", {"words.png", "it is neither PNG"}},
    {"TextureOfNothing", kRest + "texture { name: \"t\" file: \"empty.png\" }", {"empty.png"}},
    {"TextureIsAFolder", kRest + "texture { name: \"t\" file: \"folder.png\" }", {"folder.png"}},
    {"TextureIsADevice", kRest + "texture { name: \"t\" file: \"/dev/zero\" }", {"/dev/zero"}},
    {"TextureIsAPipe", kRest + "texture { name: \"t\" file: \"pipe\" }", {"pipe"}},
    {"TextureOutsideTheFolder",
     kRest + "texture { name: \"t\" file: \"../../../../../../etc/passwd\" }",
     {"passwd", "it is neither PNG"}},
    {"TextureInProc", kRest + "texture { name: \"t\" file: \"/proc/self/mem\" }", {"mem"}},
    {"TextureNameTooLong", kRest + "texture { name: \"t\" file: \"" + std::string(300, 'x') + "\" }", {}},
    {"MapIsAPipe", kRest + "environment { file: \"pipe.exr\" }", {"pipe.exr"}},
    {"MapIsADevice", kRest + "environment { file: \"zero.hdr\" }", {"zero.hdr"}},
    {"ModelIsADevice", kRest + "model { file: \"zero.obj\" }", {"zero.obj"}},
    {"ModelIsAFolder", kRest + "model { file: \"..\" }", {"not a file"}},
};
const auto caseName = [](const auto& instance) { return std::string(instance.param.name); };
INSTANTIATE_TEST_SUITE_P(Text, HostileScenes, ::testing::ValuesIn(kTexts), caseName);
INSTANTIATE_TEST_SUITE_P(Counts, HostileScenes, ::testing::ValuesIn(kCounts), caseName);
INSTANTIATE_TEST_SUITE_P(Shapes, HostileScenes, ::testing::ValuesIn(kShapes), caseName);
INSTANTIATE_TEST_SUITE_P(References, HostileScenes, ::testing::ValuesIn(kReferences), caseName);

class HostileSceneFiles : public testing::ModelFiles {};

TEST_F(HostileSceneFiles, ThatAreNoFiles) {
    std::filesystem::create_directories(directory_ / "folder.textproto");
    std::filesystem::create_symlink("/dev/zero", directory_ / "zero.textproto");
    std::filesystem::create_symlink("loop.textproto", directory_ / "loop.textproto");
    ASSERT_EQ(::mkfifo((directory_ / "pipe.textproto").c_str(), 0600), 0);
    for (const char* name : {"folder.textproto", "zero.textproto", "loop.textproto", "pipe.textproto"}) {
        const Outcome outcome = loadInChild((directory_ / name).string());
        EXPECT_EQ(outcome.ending, Ending::InputError) << name << outcome;
        EXPECT_EQ(objectionTo(outcome, name), "") << outcome;
    }
    for (const char* path : {"/dev/zero", "/dev/stdin", "/", "", "/proc/self/mem"}) {
        const Outcome outcome = loadInChild(path);
        EXPECT_EQ(outcome.ending, Ending::InputError) << path << outcome;
        EXPECT_EQ(objectionTo(outcome, path), "") << outcome;
    }
}

/// What looks hostile but is sound.
TEST_F(HostileSceneFiles, OddButSound) {
    const std::string odd[] = {
        "\xef\xbb\xbf" + kRest,                          // byte order mark
        kRest + "image { width: 65536 height: 65536 }",  // the renderer's to judge
        kRest +
            "texture { name: \"t\" texels { width: 1 height: 1 rgba: \"abcd\" } } texture { name: \"t\" texels { "
            "width: 1 height: 1 rgba: \"abcd\" } }",
        kRest +
            "mesh { name: \"q\" material: \"paint\" positions: [0,0,0, 1e-46,0,0, 0,1,0, 0,0,1] triangles: [0,1,2, "
            "0,2,3, 1,2,3] }",
        "directional_light { direction: [1e-30, 0, 0] irradiance: [1, 1, 1] }" + kPaint + kBall,
    };
    for (const std::string& text : odd) {
        const Outcome outcome = loadInChild(write("odd.textproto", text));
        EXPECT_EQ(objectionTo(outcome, "odd.textproto"), "") << text << outcome;
        if (!text.starts_with("\xef")) {
            EXPECT_EQ(outcome.ending, Ending::Returned) << text << outcome;
        }
    }
}

}  // namespace
}  // namespace antipode::test
