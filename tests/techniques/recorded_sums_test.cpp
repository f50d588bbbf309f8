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
    {"cornell/area", "ca27c583074f064ae2398ba5d3257a272da11441d046e37e612adb83a2ae67dc",
     "7afd4a30d4dc8c60fe33d2169c4f83c90f8e976805be943be93e35024f1a13d3"},
    {"cornell/point", "f994cb714d0047ca6256a780f4078c6cf9f908c1f0a63aa425ef6508c3ee1784",
     "95a4a86793ca2c8a2d5d2e03fcbd5e9f1b2c96b81439699d99e2ca8fd4dfc727"},
    {"cornell/sky", "29009a0fe87f5ba8369df77eeda80d29fecf146e799482891af9407d04ec5087",
     "14897e580db7a5453a6031f6f7c0fbaea7dce5a3e010f9de9f2e007c0bd9fb77"},
    {"cornell/sun", "847f0cd271915a9e6238a34c0176c6a09933f88522500f929f4f6d961e3423e4",
     "b5828501ba4533c39b3e511caaa94e069a7ccef845174cbce27af559be7814a2"},
    {"furnace/closed", "13f3194d1428c9c5912baaff2fd3765a91720faf20a3dd4ab62681df75614ca0",
     "8307738292e2c880a70585d5af882aad05adf18545fc6ea3688015431b367541"},
    {"furnace/glass", "234808225cad7d53225370279e8eb6bafb57e70267f8fb64dbf02a7efd034985",
     "6b68738994fedc84e34a864e870e30e90da1b023f53d143bd96a3b4ad672663a"},
    {"furnace/white", "430acd8bfffe2c8960414ee3d61b3b7a3a813a7bead2b478cd49b17ed662631a",
     "fd7de9d110311d1c0cff05e8849666b65e46d1b29a6ec04c8770a9a98aaed0ee"},
    {"glass_caustics", "4755d18f64a68afe76362239b527eb088cb019fd5e257ac93eddcd4e12340e86",
     "0d37078df7351fd9372ee2d2d7227eaaf1710f4c4dafdd5812837ebc3232fc01"},
    {"pool", "ac0b7c8b0ba8401116dc846b84fcfc819f38dc5db6284011c78dfcd68159cf0a",
     "1a0f04ad4315005d6ce84b36312fbc8fbdb8dfc46a338c6900c57b082c87a7a6"},
    {"veach_mis", "ba85ed286e4f67dc70876e01ba74d082bbec8e3b7a0ac8f462b0324a50539896",
     "6fbe70d7ecb3c22f50344614e1faabaa071577a56e58536885007fc76cc3e4dc"},
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
