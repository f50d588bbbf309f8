#include "client/render_options.h"

#include <gtest/gtest.h>

#include "client/frames.h"
#include "renderengine/error.h"

using namespace antipode;

namespace {

Precision precisionOf(const std::vector<std::string>& arguments) {
    const auto options = parseRenderOptions(arguments);
    EXPECT_TRUE(options);
    return options->settings.precision;
}

}  // namespace

TEST(RenderOptions, NoLightPathsLeavesOutAllThatNeedsThem) {
    const auto without = [](const std::vector<std::string>& arguments) {
        return name(parseRenderOptions(arguments)->settings.without);
    };
    EXPECT_EQ(without({"s.textproto"}), "none");
    EXPECT_EQ(without({"s.textproto", "--without", "merging,next-event"}), "next-event,merging");
    EXPECT_EQ(without({"s.textproto", "--light-paths", "0"}), "light-tracing,connections,merging");
    EXPECT_EQ(without({"s.textproto", "--light-paths", "0", "--technique", "bpm"}), "merging");
    EXPECT_EQ(without({"s.textproto", "--light-paths", "0", "--technique", "pt"}), "none");
    EXPECT_EQ(without({"s.textproto", "--light-paths", "9"}), "none");
}

TEST(RenderOptions, PrecisionIsFloatUnlessDoubleIsAskedFor) {
    EXPECT_EQ(precisionOf({"s.textproto"}), Precision::Float);
    EXPECT_EQ(precisionOf({"s.textproto", "--precision", "float"}), Precision::Float);
    EXPECT_EQ(precisionOf({"s.textproto", "--precision", "double"}), Precision::Double);
    EXPECT_EQ(precisionOf({"--precision=double", "s.textproto"}), Precision::Double);
}

TEST(RenderOptions, SamplerIsSobolUnlessIndependentNumbersAreAskedFor) {
    const auto samplerOf = [](const std::vector<std::string>& arguments) {
        return parseRenderOptions(arguments)->settings.sampler;
    };
    EXPECT_EQ(samplerOf({"s.textproto"}), Sampler::Sobol);
    EXPECT_EQ(samplerOf({"s.textproto", "--sampler", "sobol"}), Sampler::Sobol);
    EXPECT_EQ(samplerOf({"s.textproto", "--sampler", "independent"}), Sampler::Independent);
}

TEST(RenderOptions, FramesNumberTheirFilesAndTellTheirTime) {
    const auto options =
        parseRenderOptions({"s.glb", "--frames", "8-12", "--fps", "4", "-o", "out/s_###.exr", "--checkpoint", "s#"});
    ASSERT_TRUE(options && options->frames);
    EXPECT_EQ(options->frames->first, 8u);
    EXPECT_EQ(options->frames->last, 12u);
    const RenderOptions one = optionsOfFrame(*options, 10);
    EXPECT_EQ(one.exrPath, "out/s_010.exr");
    EXPECT_EQ(one.pngPath, "out/s_010.png");
    EXPECT_EQ(one.checkpointPath, "s10") << "more digits than there is room for";
    EXPECT_EQ(one.import.animationTime, 2.5);
    EXPECT_EQ(optionsOfFrame(*parseRenderOptions({"s.glb", "--frames", "7"}), 7).exrPath, "s_0007.exr");
}

TEST(RenderOptions, FramesThatMakeNoSenseAreRefused) {
    const auto refused = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "s.glb");
        EXPECT_THROW(parseRenderOptions(arguments), Error);
    };
    refused({"--frames", "5-2"});
    refused({"--frames", "a-b"});
    refused({"--frames", "1-"});
    refused({"--frames", "1-2", "--animation-time", "1"});
    refused({"--frames", "1-2", "--stats", "all.json"});
    refused({"--overwrite"});
}
