#include "client/render_options.h"

#include <gtest/gtest.h>

using namespace antipode;

namespace {

Precision precisionOf(const std::vector<std::string>& arguments) {
    const auto options = parseRenderOptions(arguments);
    EXPECT_TRUE(options);
    return options->settings.precision;
}

}  // namespace

TEST(RenderOptions, PrecisionIsFloatUnlessDoubleIsAskedFor) {
    EXPECT_EQ(precisionOf({"s.textproto"}), Precision::Float);
    EXPECT_EQ(precisionOf({"s.textproto", "--precision", "float"}), Precision::Float);
    EXPECT_EQ(precisionOf({"s.textproto", "--precision", "double"}), Precision::Double);
    EXPECT_EQ(precisionOf({"--precision=double", "s.textproto"}), Precision::Double);
}
