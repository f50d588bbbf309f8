// Model files that are cut off, damaged, or made to do harm.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include <sys/stat.h>

#include "support/hard_case.h"
#include "tests/inputs/child_process.h"
#include "tests/inputs/mutations.h"
#include "tests/scene/model_files.h"

namespace antipode::test {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models";

struct SoundModel {
    const char* name;
    const char* file;
};

class BrokenModels : public testing::ModelFiles {
protected:
    Outcome load(const std::string& name, const std::string& content) {
        return loadInChild(write(name, content), ChildLimits{40, uint64_t(4) << 30});
    }
    /// The sentence with which the file is refused, or a failure.
    std::string refusal(const std::string& name, const std::string& content) {
        const Outcome outcome = load(name, content);
        EXPECT_EQ(outcome.ending, Ending::InputError) << outcome;
        EXPECT_EQ(objectionTo(outcome, name), "") << outcome;
        return outcome.text;
    }
};

class DamagedModels : public BrokenModels, public ::testing::WithParamInterface<SoundModel> {
protected:
    void SetUp() override {
        if (!fs::exists(kModels / GetParam().file)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
        BrokenModels::SetUp();
        sound_ = readBytes((kModels / GetParam().file).string());
        name_ = "model" + fs::path(GetParam().file).extension().string();
    }
    void TearDown() override {
        if (!directory_.empty()) BrokenModels::TearDown();
    }
    void expectNoHarm(const std::string& difficulty, const Bytes& content, const std::string& what) {
        const Outcome outcome = loadInChild(write(name_, content), ChildLimits{40, uint64_t(2) << 30});
        const std::string objection = objectionTo(outcome, name_);
        SCOPED_TRACE(::testing::Message() << GetParam().file << ", " << what << ": " << objection << "\n" << outcome);
        expectWithin({"Bad input", difficulty, "loads that end neither in a scene nor in one clear sentence", 0},
                     !objection.empty());
    }

    Bytes sound_;
    std::string name_;
};

TEST_P(DamagedModels, CutOff) {
    for (int part = 0; part < 16; ++part)
        expectNoHarm("a model file that is cut off, at every sixteenth",
                     Bytes(sound_.begin(), sound_.begin() + std::ptrdiff_t(sound_.size() * part / 16)),
                     "cut at " + std::to_string(part) + "/16");
}

TEST_P(DamagedModels, BitsTurnedOver) {
    for (uint64_t seed = 0; seed < 40; ++seed)
        expectNoHarm("a model file with bits turned over", withFlippedBits(sound_, seed),
                     "bits turned over by seed " + std::to_string(seed));
}

INSTANTIATE_TEST_SUITE_P(
    Formats, DamagedModels,
    ::testing::Values(SoundModel{"Obj", "OBJ/spider.obj"}, SoundModel{"PlyBinary", "PLY/cube_uv.ply"},
                      SoundModel{"Collada", "Collada/lights.dae"}, SoundModel{"FbxBinary", "FBX/box.fbx"},
                      SoundModel{"FbxText", "FBX/embedded_ascii/box.FBX"},
                      SoundModel{"Glb", "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb"},
                      SoundModel{"Gltf", "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf"},
                      SoundModel{"StlBinary", "STL/Spider_binary.stl"}, SoundModel{"StlText", "STL/Spider_ascii.stl"},
                      SoundModel{"Off", "OFF/Cube.off"}, SoundModel{"ThreeDs", "3DS/fels.3ds"}),
    [](const auto& instance) { return instance.param.name; });

/// Assimp 5.2 looks for the header's end forever.
TEST_F(BrokenModels, AnEndlessImportEnds) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string sentence = refusal("m.ply", "ply\nformat ascii");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    EXPECT_NE(sentence.find("came to no end"), std::string::npos) << sentence;
}

/// Assimp 5.2 dereferences a null pointer where raw triangles with texture names come in groups.
TEST_F(BrokenModels, ACrashOfTheImporterIsAnError) {
    const std::string sentence = refusal("m.raw", "0 0 0 0 1 0 1 0 0 a.png\n\nsecond\n0 0 0 0 1 0 1 0 0 b.png\n");
    EXPECT_NE(sentence.find("the importer crashed on it"), std::string::npos) << sentence;
}

TEST_F(BrokenModels, UnknownExtensionsAreRefusedBeforeReading) {
    EXPECT_NE(refusal("picture.png", "\x89PNG\r\n").find(".png"), std::string::npos);
    refusal("noextension", "v 0 0 0\n");
    refusal("m.obj.bak", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

TEST_F(BrokenModels, FilesThatAreNone) {
    fs::create_directories(directory_ / "folder.obj");
    fs::create_symlink("/dev/zero", directory_ / "zero.obj");
    fs::create_symlink("nowhere", directory_ / "dangling.glb");
    ASSERT_EQ(::mkfifo((directory_ / "pipe.ply").c_str(), 0600), 0);
    for (const char* name : {"folder.obj", "zero.obj", "dangling.glb", "pipe.ply", "missing.gltf"}) {
        const Outcome outcome = loadInChild((directory_ / name).string());
        EXPECT_EQ(outcome.ending, Ending::InputError) << name << outcome;
        EXPECT_EQ(objectionTo(outcome, name), "") << outcome;
    }
    const Outcome longName = loadInChild("/tmp/" + std::string(300, 'x') + ".obj");
    EXPECT_EQ(longName.ending, Ending::InputError) << longName;
}

TEST_F(BrokenModels, FilesNamedInsideThatNeverEnd) {
    ASSERT_EQ(::mkfifo((directory_ / "pipe").c_str(), 0600), 0);
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    for (const char* library : {"pipe", "/dev/zero", "."}) {
        const Outcome outcome = load("m.obj", std::string("mtllib ") + library + "\n" + triangle);
        EXPECT_EQ(outcome.ending, Ending::Returned) << library << outcome;  // as with any missing library
    }
    write("t.mtl", "newmtl a\nmap_Kd pipe\n");
    // A substitute stands for a picture that cannot be had.
    EXPECT_EQ(load("t.obj", "mtllib t.mtl\nvt 0 0\n" + triangle).ending, Ending::Returned);
    testing::TriangleGltf gltf;
    gltf.json["buffers"][0]["uri"] = "pipe";
    EXPECT_NE(refusal("m.gltf", gltf.json.dump()).find("pipe"), std::string::npos);
}

TEST_F(BrokenModels, GltfNestedDeeply) {
    const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
    EXPECT_NE(refusal("deep.gltf", R"({"asset":{"version":"2.0"},"extras":)" + deep + "}").find("nested"),
              std::string::npos);
    refusal("open.gltf", std::string(10000000, '['));
}

TEST_F(BrokenModels, GltfNodesInCyclesAndLongChains) {
    testing::TriangleGltf gltf;
    gltf.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
    refusal("cycle.gltf", gltf.json.dump());
    gltf.json["nodes"] = {{{"children", {0}}, {"mesh", 0}}};
    refusal("self.gltf", gltf.json.dump());
    gltf = {};
    auto& nodes = gltf.json["nodes"] = nlohmann::json::array();
    for (int i = 1; i < 200000; ++i) nodes.push_back({{"children", {i}}});
    nodes.push_back({{"mesh", 0}});
    const auto glb = gltf.glb();
    EXPECT_NE(refusal("chain.glb", std::string(glb.begin(), glb.end())).find("node"), std::string::npos);
}

TEST_F(BrokenModels, GltfCountsBeyondTheData) {
    const auto with = [](auto&& spoil) {
        testing::TriangleGltf gltf;
        spoil(gltf.json);
        const auto glb = gltf.glb();
        return std::string(glb.begin(), glb.end());
    };
    refusal("a.glb", with([](auto& j) { j["accessors"][1]["count"] = 2147483648u; }));
    refusal("b.glb", with([](auto& j) { j["accessors"][0]["count"] = 18446744073709551615u; }));
    refusal("c.glb", with([](auto& j) { j["bufferViews"][0]["byteLength"] = 4294967296u; }));
    refusal("d.glb", with([](auto& j) { j["buffers"][0]["byteLength"] = 4294967295u; }));
    refusal("e.glb", with([](auto& j) { j["accessors"][0]["count"] = -3; }));
    refusal("f.glb", with([](auto& j) { j["nodes"][0]["mesh"] = 7; }));
    refusal("g.glb",
            with([](auto& j) { j["accessors"][1].erase("bufferView"), j["accessors"][1]["count"] = 300000000; }));
    refusal("h.glb", with([](auto& j) { j["meshes"][0]["primitives"][0]["material"] = 99; }));
}

TEST_F(BrokenModels, NamesThatAreNoText) {
    const std::string obj = "mtllib m.mtl\no gr\xfcn\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl gr\xfcn\nf 1 2 3\n";
    write("m.mtl", "newmtl gr\xfcn\nKd 0 1 0\n");
    const Outcome outcome = load("m.obj", obj);
    EXPECT_EQ(outcome.ending, Ending::Returned) << outcome;
    const Scene scene = importModel((directory_ / "m.obj").string());
    EXPECT_EQ(scene.materials.at(0).name, "grün");
}

}  // namespace
}  // namespace antipode::test
