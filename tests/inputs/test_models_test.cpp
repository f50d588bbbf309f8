// All files of Assimp's own test models (Debian: assimp-testmodels): rare formats, odd encodings, broken files, and
// files that are no models at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <vector>

#include "tests/inputs/child_process.h"

namespace antipode::test {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models";

/// Of version 5.2.5; a list in the source keeps the names of the test cases the same on all machines.
const char* const kFolders[] = {"3D",         "3DS", "3MF",  "AC",    "AMF",     "ASE",          "B3D",
                                "BLEND",      "BVH", "COB",  "CSM",   "Collada", "DXF",          "FBX",
                                "HMP",        "IFC", "IQM",  "IRR",   "IRRMesh", "JT",           "LWO",
                                "LWS",        "M3D", "MD2",  "MD5",   "MDC",     "MDL",          "MS3D",
                                "NFF",        "OBJ", "OFF",  "Ogre",  "OpenGEX", "PLY",          "Q3D",
                                "RAW",        "SIB", "SMD",  "STL",   "TER",     "WRL",          "X",
                                "X3D",        "XGL", "glTF", "glTF2", "invalid", "ParsingFiles", "ReferenceImages",
                                "SourceFiles"};

class TestModels : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (!fs::is_directory(kModels)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
    }
};

TEST_P(TestModels, GiveASceneOrAClearError) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(kModels / GetParam()))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    int loaded = 0, refused = 0;
    for (const fs::path& file : files) {
        const Outcome outcome = loadInChild(file.string());
        EXPECT_EQ(objectionTo(outcome, file.string()), "") << file << "\n" << outcome;
        ++(outcome.ending == Ending::Returned ? loaded : refused);
    }
    RecordProperty("loaded", loaded);
    RecordProperty("refused", refused);
    std::cout << GetParam() << ": " << loaded << " loaded, " << refused << " refused\n";
}

INSTANTIATE_TEST_SUITE_P(Folder, TestModels, ::testing::ValuesIn(kFolders),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(TestModelsFolders, AreAllListed) {
    if (!fs::is_directory(kModels)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
    for (const auto& entry : fs::directory_iterator(kModels)) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(std::find(std::begin(kFolders), std::end(kFolders), name) != std::end(kFolders)) << name;
    }
}

/// What sound files of the formats that people use must give, so that "refused" cannot hide a broken importer.
TEST(TestModelsFolders, SoundFilesLoad) {
    if (!fs::is_directory(kModels)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
    for (const char* file :
         {"OBJ/spider.obj", "PLY/Wuson.ply", "PLY/cube_binary.ply", "Collada/sphere.dae", "FBX/box.fbx",
          "STL/Spider_ascii.stl", "STL/Spider_binary.stl", "3DS/fels.3ds", "OFF/Cube.off", "LWO/LWO2/boxuv.lwo",
          "OpenGEX/collada.ogex", "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb"}) {
        const Outcome outcome = loadInChild((kModels / file).string());
        EXPECT_EQ(outcome.ending, Ending::Returned) << file << "\n" << outcome;
    }
}

}  // namespace
}  // namespace antipode::test
