#include "renderengine/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace antipode {
namespace {

Image uniform(float value) { return {10, 10, std::vector<Vec3f>(100, Vec3f(value))}; }

TEST(Exposure, StopsDouble) {
    EXPECT_EQ(exposed(uniform(0.25f), 2).pixels[7], Vec3f(1.0f));
    EXPECT_EQ(exposed(uniform(0.25f), -1).pixels[7], Vec3f(0.125f));
}

TEST(Exposure, WhatCanBeSeenStaysAsItIs) {
    for (float value : {0.31f, 0.5f, 0.89f}) EXPECT_EQ(autoExposure(uniform(value)), 0) << value;
    Image image = uniform(0.05f);
    for (size_t i = 0; i < 5; ++i) image.pixels[i] = Vec3f(2.0f);
    EXPECT_EQ(autoExposure(image), 0);
}

TEST(Exposure, BrightAndDarkOnesComeToTheSameGrey) {
    // log2(.2/v)/2 + log2(1/v)/2 = log2(√.2/v).
    for (float value : {247.0f, 1e-4f}) {
        const double stops = autoExposure(uniform(value));
        EXPECT_NEAR(stops, std::log2(std::sqrt(0.2) / value), 0.05);
        EXPECT_NEAR(stops * 10, std::round(stops * 10), 1e-9);
    }
}

TEST(Exposure, BlackBackgroundsAndBrokenPixelsDoNotCount) {
    Image image = uniform(0.0f);
    EXPECT_EQ(autoExposure(image), 0);
    for (size_t i = 0; i < 10; ++i) image.pixels[i] = Vec3f(0.5f);
    image.pixels[20] = Vec3f(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(autoExposure(image), 0);
    EXPECT_EQ(autoExposure(Image{}), 0);
}

}  // namespace
}  // namespace antipode
