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
    {"cornell/area", "9355f192adb43bf98c8805615563562c13684e3ba57b46c20d1917520b65d155",
     "65afa058f710f3e0a1406790fb3e60240dbc2a643f349fa91027a7a2483568f9"},
    {"cornell/point", "308f7128e2f7063c567cf3b7e5549ad2d86f67880128b51f283e518e93b341b8",
     "f2827f9c38a20c718b56e57dd5757f674d6d530b366ae227651d255d2c980ba6"},
    {"cornell/sky", "a5727ce7373555c81a089ddfd0fcc0d919a5c66caf5844200906c6c451c2078c",
     "09b2544d083984a49877a15cb5cddce16a5da81db0c88dcdc723690cf44d55f6"},
    {"cornell/sun", "d1ffa8435dbf477de538ea12a2138fc76c5f051c432e2e1bede9ba8c92e4e789",
     "5126d2f82de2ebc44299e147b9859cf000c114ee8f023bf4e428b209bdbc2e66"},
    {"furnace/closed", "462cc03510931f52fea84b4fb4dee064f47d1340aecf119233cf1532a2a85102",
     "ee9f910696e61e96d0d54853893a8d74882cfec5e9f860683956c46bbdff50f0"},
    {"furnace/glass", "234808225cad7d53225370279e8eb6bafb57e70267f8fb64dbf02a7efd034985",
     "6b68738994fedc84e34a864e870e30e90da1b023f53d143bd96a3b4ad672663a"},
    {"furnace/white", "430acd8bfffe2c8960414ee3d61b3b7a3a813a7bead2b478cd49b17ed662631a",
     "fd7de9d110311d1c0cff05e8849666b65e46d1b29a6ec04c8770a9a98aaed0ee"},
    {"glass_caustics", "9e053bc68e55f400f123a45bfd55030b16c704309eb1fcbf1d06719606a9800e",
     "0d37078df7351fd9372ee2d2d7227eaaf1710f4c4dafdd5812837ebc3232fc01"},
    {"pool", "5cb8953aedce58acbd948e23ddd4fa9a127beca05a5c7be624c5c2138f6f21e9",
     "8dff39fc421a3e1f8e87ef3db4b2d33cc1adc2111e722ec269664f478ce9e621"},
    {"veach_mis", "c2df393eb6835a7daf41ce37eedc8cd9bb3480fafac3a49d5e1a13142e6d34cf",
     "b1d995373f56bd5ad9e0d04f2430afff6dcb981af0d072efaf4dcb4f9750b743"},
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
INSTANTIATE_TEST_SUITE_P(All, RecordedSums, testing::ValuesIn(kRecorded), [](const auto& row) {
    std::string name = row.param.scene;
    for (char& c : name)
        if (c == '/') c = '_';
    return name;
});

}  // namespace
}  // namespace antipode::test
