// The sums of the eleven shipped scenes as they were recorded: a change that moves code must not change a byte, and a
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
    {"cornell/area", "9a30fa6fa83cd2de3196507d7013448efaf1f295e81cf2104a915bbe290f8181",
     "caab762fdb16434219f5234bc173226cede7ede0bd80751bc78b27b556e7667c"},
    {"cornell/point", "ec8def82740db3cc00ea6fa607ad77ff41e985d0bcf33c6687cc8005a7223117",
     "1c8ee73c5d3201d1d162efe926b8275abd5b0ffe3b4fef0689f7ed899e0f0506"},
    {"cornell/sky", "64917eac3d126f8f1fdd182edd6d15deb81940674981174d6138389c0632a35a",
     "1a8a3ad1968b36b3f08b2fd5d89953425f1b99fa5eab5eb30b8c547855da9f85"},
    {"cornell/sun", "beb54e7c19a0ea89dfd04393567bc0c9c0624d7ea4a5d4337ff6831228d76c5c",
     "f75801e0966e667917d7c697bcd2729062f7df41787265dbf46145323d9bf18f"},
    {"furnace/closed", "4db3882f13c7fd955e70a4ca059a5d2f529314a1a5b553cd90fd33704a2cbb63",
     "02d56b7837528887df3f2ff787e0f2e892b4fea4856e93fba4832bb4cd656369"},
    {"furnace/glass", "d892eca58d632d768744808b9dec467707a13add60f230d94b6c07160266495f",
     "f070f3722a474c07399f1bca721e85ac627621f90c99dc606342e70deab4d946"},
    {"furnace/white", "6ddf33cd8fe58727285088cf76e7966cb8a36c8a507db4d8d7d2342fccd81408",
     "0eb96b2fc14db16ce90cfc28b1c604412d8a01d33125880bfe48ad6aea89301f"},
    {"glass_caustics", "6ba978f79b259e1a27954ba5fa589f854672eabe3872023eeec5fda213d6a353",
     "1e72c971bcc87d89407189a1ac4df0176d344582a080cf4e426a3e2050c7350c"},
    {"lacquer", "d206cfdc38c670c4bd660f0dbcc8840dfca43005738c679fd0b87badab5bb57c",
     "f5e18ceee67e70c5a104fa22be93e61e18287ab2fa4ad5106420718c0eebb6be"},
    {"pool", "420849a3500c00fe234cd07e6dd8d693d76dbe6338f0d60996e6dc963ff0e9a0",
     "2c342be5b8a53468ab792a85f9fbd434b20f5eaf01818700b3210924cfd1cf61"},
    {"veach_mis", "64a690a0ff09b2a4ee6cb2430b3554eb6ad0c384ff24b9e03f5c7d3827de4f73",
     "df24c56ed1b427c03acdf17ba853e907df9b84bee5743c93bec057aeebdf2b99"},
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
