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
    {"cornell/area", "f6fb159f9dab244a915530d48e74dd0008cb5bb116ab5386c1415d51a7eb4e39",
     "65afa058f710f3e0a1406790fb3e60240dbc2a643f349fa91027a7a2483568f9"},
    {"cornell/point", "f2da2ae1adf2e4491b88a67e8656e1acb1b38ab12d8bd8e836d8ad984a01f014",
     "f2827f9c38a20c718b56e57dd5757f674d6d530b366ae227651d255d2c980ba6"},
    {"cornell/sky", "8ff04cd861b9efac9434c01ab3cd50cda4a3cd625950c27563859dd0237c7055",
     "09b2544d083984a49877a15cb5cddce16a5da81db0c88dcdc723690cf44d55f6"},
    {"cornell/sun", "bb5300b2f0a79e9900850b8106f71e2fd5f10b613682da0bd7e983ace5c873c5",
     "5126d2f82de2ebc44299e147b9859cf000c114ee8f023bf4e428b209bdbc2e66"},
    {"furnace/closed", "6ca00362a9d5218b720a27347465c31fc352f620428d4b83b75159fc93e26de1",
     "ee9f910696e61e96d0d54853893a8d74882cfec5e9f860683956c46bbdff50f0"},
    {"furnace/glass", "234808225cad7d53225370279e8eb6bafb57e70267f8fb64dbf02a7efd034985",
     "6b68738994fedc84e34a864e870e30e90da1b023f53d143bd96a3b4ad672663a"},
    {"furnace/white", "cd3f8f36169ca0264a8710a653c917093eb27f7c62aefa3e9fc6ca9cce82d4c0",
     "fd7de9d110311d1c0cff05e8849666b65e46d1b29a6ec04c8770a9a98aaed0ee"},
    {"glass_caustics", "89494c0fb23c1dd1cafbc7a57b66d4c0dfe42e7916eb84793f09eccc254adb02",
     "0d37078df7351fd9372ee2d2d7227eaaf1710f4c4dafdd5812837ebc3232fc01"},
    {"pool", "fd04b374ebda7bde0202b10db7d895d1c84313b3b15fd922e23a63b4f2ccadc2",
     "8dff39fc421a3e1f8e87ef3db4b2d33cc1adc2111e722ec269664f478ce9e621"},
    {"veach_mis", "408cb1eee7685abef7eac558d15c7ec4de13e5026e00b5c02607edff063414b3",
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
INSTANTIATE_TEST_SUITE_P(All, RecordedSums, testing::ValuesIn(kRecorded), [](const auto& info) {
    std::string name = info.param.scene;
    for (char& c : name)
        if (c == '/') c = '_';
    return name;
});

}  // namespace
}  // namespace antipode::test
