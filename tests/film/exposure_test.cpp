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

/// Linear RGB of luminance 1, by the inverse of IEC 61966-2-1's matrix in its four digits.
Vec3f ofChromaticity(double x, double y) {
    const double X = x / y, Z = (1 - x - y) / y;
    return Vec3f(
        Vec3d(3.2406 * X - 1.5372 - 0.4986 * Z, -0.9689 * X + 1.8758 + 0.0415 * Z, 0.0557 * X - 0.2040 + 1.0570 * Z));
}

TEST(WhiteBalance, LightOfTheTemperatureIsWhite) {
    struct Illuminant {
        double kelvin, x, y;
    };
    // CIE 15: A, D50, D55, D65, D75.
    for (const auto& [kelvin, x, y] :
         {Illuminant{2856, .44757, .40745}, Illuminant{5003, .34567, .35850}, Illuminant{5503, .33242, .34743},
          Illuminant{6504, .31271, .32902}, Illuminant{7504, .29902, .31485}}) {
        const Vec3f white = whiteBalanced({1, 1, {ofChromaticity(x, y)}}, kelvin).pixels[0];
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 0.012) << kelvin << " K, channel " << c;
    }
}

TEST(WhiteBalance, DaylightChangesNothingAndWarmerIsBluer) {
    const Vec3f colour(0.8f, 0.3f, 0.1f);
    const Vec3f same = whiteBalanced({1, 1, {colour}}, daylightKelvin).pixels[0];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(same[c], colour[c], 2e-6);
    // Below 2600 K the grey of daylight is a blue that sRGB does not hold: its red is negative.
    Vec3f before = whiteBalanced(uniform(0.5f), 25000).pixels[0];
    for (double kelvin = 24900; kelvin > 1700; kelvin -= 100) {
        const Vec3f grey = whiteBalanced(uniform(0.5f), kelvin).pixels[0];
        EXPECT_GT(grey.z, before.z) << kelvin;
        EXPECT_LT(grey.x, before.x) << kelvin;
        before = grey;
    }
}

}  // namespace
}  // namespace antipode
