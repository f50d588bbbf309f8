#include "film/tone_curve.h"

#include <limits>

#include <gtest/gtest.h>

using namespace antipode;

using Pixel = std::array<uint8_t, 3>;

TEST(ToneCurve, MidTonesAreShownAsTheyAre) {
    for (const Vec3f& rgb : {Vec3f(0.0f), Vec3f(0.18f), Vec3f(0.5f, 0.25f, 0.01f), Vec3f(0.01f, 0.5f, 0.49f)})
        EXPECT_EQ(toneCurve(rgb), Vec3d(rgb));
}

TEST(ToneCurve, ShoulderJoinsSmoothlyAndRisesWithoutReachingWhite) {
    const auto grey = [](double x) { return toneCurve(Vec3f(float(x))).y; };
    const double step = 0x1p-10;
    EXPECT_NEAR((grey(0.5 + step) - grey(0.5)) / step, 1.0, 4 * step);  // slope 1 − 2·step/d + O(step²), d = ½
    double previous = 0.5;
    for (double x = 0.51; x < 1e5; x *= 1.1) {
        EXPECT_GT(grey(x), previous) << x;
        EXPECT_LT(grey(x), 1.0) << x;
        previous = grey(x);
    }
    EXPECT_NEAR(grey(1.0), 0.75, 1e-12);
    EXPECT_LT(grey(2.0), grey(4.0) - 0.05);  // highlights keep contrast
}

TEST(ToneCurve, KeepsHueWhileItBurnsOut) {
    // Hue: the middle component's place between the smallest and the largest.
    const auto hue = [](const Vec3d& c) { return (c.y - c.z) / (c.x - c.z); };
    const auto chroma = [](const Vec3d& c) { return (c.x - c.z) / c.x; };
    double previousChroma = 1;
    for (float scale = 1; scale < 1e4f; scale *= 4) {
        const Vec3f rgb(scale, 0.5f * scale, 0.125f * scale);
        const Vec3d shown = toneCurve(rgb);
        EXPECT_NEAR(hue(shown), hue(Vec3d(rgb)), 1e-9) << scale;
        EXPECT_LT(chroma(shown), previousChroma) << scale;
        previousChroma = chroma(shown);
    }
    EXPECT_LT(previousChroma, 0.01);
}

TEST(ToneCurve, StaysInRangeForEveryFiniteRadiance) {
    const float largest = std::numeric_limits<float>::max();
    for (const Vec3f& rgb : {Vec3f(largest), Vec3f(largest, 0, -largest), Vec3f(-1), Vec3f(541127, 381972, 127324)}) {
        const Vec3d shown = toneCurve(rgb);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(shown[c], 0.0);
            EXPECT_LE(shown[c], 1.0);
        }
    }
}

TEST(ToneCurve, EncodesSrgb) {
    EXPECT_EQ(encodeSrgb8(0.0), 0);
    EXPECT_EQ(encodeSrgb8(1.0), 255);
    EXPECT_EQ(encodeSrgb8(0.18), 118);      // 255·0.46136
    EXPECT_EQ(encodeSrgb8(0.0031308), 10);  // 255·0.04045, where the linear part ends
    EXPECT_EQ(encodeSrgb8(0.5), 188);       // 255·0.73536
}

TEST(ToneCurve, ShowsBrokenPixelsInMagenta) {
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(displayPixel({0, infinity, 0}), (Pixel{255, 0, 255}));
    EXPECT_EQ(displayPixel({nan, 0, 0}), (Pixel{255, 0, 255}));
    EXPECT_EQ(displayPixel({0.18f, 0, 1e9f})[2], 255);
}
