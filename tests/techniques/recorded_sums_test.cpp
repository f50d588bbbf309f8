// The sums of the ten shipped scenes as they were recorded: a change that moves code must not change a byte, and a
// change of the picture has to say so by recording anew (the failing test prints the line).
//
// Sums are bytes of one device class, so the test is skipped on any other than the one that they were recorded on.
#include <filesystem>

#include "proto/scene_loader.h"
#include "tests/techniques/engine_fixture.h"

namespace antipode::test {
namespace {

constexpr const char* kRecordedOn = "llvmpipe (LLVM 15.0.6";

struct Recorded {
    const char* scene;
    const char* vcm;  ///< sha256 of the sums of iterations 1 and 2, 48×32, seed 1, at most 12 edges
    const char* pt;   ///< the same by path tracing, in double
};

void PrintTo(const Recorded& recorded, std::ostream* out) { *out << recorded.scene; }

const Recorded kRecorded[] = {
    {"cornell/area", "9961772d421eff75f1a58947ab87ef858b8d5fbfb343914cddf8c0015c3d78ff",
     "393d76b629b2d876e9875e89aa51170238311f63851d3706085104762ad785b1"},
    {"cornell/point", "c56ec71fa2ee6ee9e47c08b8dc83392504e5f8860a32c6afa39f89c81b3bb553",
     "374ce8eecded291941ef0334d598ebec3f9fd7d6a911d922feb587c77a4de753"},
    {"cornell/sky", "2343822d8484129dcd6450722e1d4e7440b51190893060f9a7c7050fcd05d770",
     "e6d745325a4958e01234e9d469a35bb7b37b906dec93a57ae12d4ac246f4515a"},
    {"cornell/sun", "841a974310be9bc246634e30e52a1b259055d17553f870a205dd3175f7234ce7",
     "8537a4a98ae4f49fe20736384474ac0a7124d1bfc6bfec9f47e5092223923b0d"},
    {"furnace/closed", "55af2d5d7a3c364ea0a2f47a5c078368dc626be4b55e4edcce647c773106ebe8",
     "983e7468ddb01dffd575d8eb3d09c4bc7fa3bac2eabfa19065c48cfa218b55ba"},
    {"furnace/glass", "abe587789b5116730772211a8c1578423d6b9bd60a865b67be0c9517521c2efd",
     "b09789419bf7c70b9e87a91b51d8449ddd5f786048da338e14bb789b0b8f7e00"},
    {"furnace/white", "8e74056463c84a2e6678fd4534ae57974df847b8407fbfd3012ad83fb6837aa1",
     "49a822102061c4f9b27b340ea81c719191e69df2f0ce4427aa37df78b8e2b880"},
    {"glass_caustics", "7eab8e1eebdb11e20ed44e82fdcb44086934b7ba8ddab077902f30864a43e49e",
     "cc9450dea08b4f01c3fabf777fc41b75f799141db941e102701f0d08d50b132e"},
    {"pool", "0b00dbe5aff66c3c5c8dabe46f134dbb071732b620e2a8e75d7765c770bd3571",
     "63dcec8084899baa058d249e8df7358477b22d4c713d19e81da7198c7e0604ac"},
    {"veach_mis", "3c7fb2861890bc65f12b7f4d5f4b064f9feced09324daf5febf33574577f154c",
     "2d28a2b7e5ccc9e23f7f76c09ea6812f693ab3463102e95c34032d9b26764608"},
};

class RecordedSums : public EngineTest, public testing::WithParamInterface<Recorded> {
protected:
    static std::string sumsOf(const Scene& scene, const std::string& technique, Precision precision) {
        RenderSettings settings;
        settings.width = 48;
        settings.height = 32;
        settings.technique = technique;
        settings.precision = precision;
        settings.maxPathLength = 12;
        Engine engine(scene, settings);
        if (engine.deviceName().rfind(kRecordedOn, 0) != 0) return "";
        for (const uint64_t iteration : {1, 2}) engine.render(iteration);
        return engine.sums().sha256();
    }
};

TEST_P(RecordedSums, AreStillTheSame) {
    const Recorded& recorded = GetParam();
    const Scene scene = loadScene(ANTIPODE_SOURCE_DIR "/scenes/" + std::string(recorded.scene) + ".textproto");
    const std::string vcm = sumsOf(scene, "vcm", Precision::Float);
    if (vcm.empty()) GTEST_SKIP() << "The sums were recorded on " << kRecordedOn << "), not on this device.";
    const std::string pt = sumsOf(scene, "pt", Precision::Double);
    EXPECT_TRUE(vcm == recorded.vcm && pt == recorded.pt)
        << "    {\"" << recorded.scene << "\", \"" << vcm << "\",\n     \"" << pt << "\"},";
}
INSTANTIATE_TEST_SUITE_P(All, RecordedSums, testing::ValuesIn(kRecorded), [](const auto& info) {
    std::string name = info.param.scene;
    for (char& c : name)
        if (c == '/') c = '_';
    return name;
});

}  // namespace
}  // namespace antipode::test
