#include "renderengine/flip.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "tests/film/expect_error.h"

using namespace antipode;

namespace {

Image grey(uint32_t width, uint32_t height, float value) {
    return {width, height, std::vector<Vec3f>(size_t(width) * height, Vec3f(value))};
}

/// Coloured squares, and the same with a pattern of ±.08 and ±.04; below the tone curve's shoulder.
Image squares(bool patterned) {
    Image image{48, 32, {}};
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            float rgb[3];
            for (uint32_t c = 0; c < 3; ++c) {
                rgb[c] = 0.05f + 0.4f * float((x / 8 + y / 8 + c) % 2) * 0.9f;
                if (patterned) rgb[c] += 0.04f * float(int((x * 7 + y * 13 + c * 5) % 5) - 2);
                rgb[c] = std::max(rgb[c], 0.0f);
            }
            image.pixels.push_back({rgb[0], rgb[1], rgb[2]});
        }
    return image;
}

double mean(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace

TEST(Flip, IsNothingBetweenEqualImages) {
    for (const float error : flipErrors(squares(true), squares(true))) EXPECT_EQ(error, 0);
}

TEST(Flip, IsSymmetric) {
    const std::vector<float> there = flipErrors(squares(false), squares(true)),
                             back = flipErrors(squares(true), squares(false));
    for (size_t i = 0; i < there.size(); ++i) EXPECT_NEAR(there[i], back[i], 1e-6);
}

// A flat grey stays what it is under every filter and has no feature, so that by hand: lightness of .1 and .2 is
// L = 116·Y^(1/3) − 16 = 37.842 and 51.837, no chroma; 13.995^.7 = 6.341; the largest distance, green to blue with the
// Hunt effect, is 203.3^.7 = 41.276 (by the authors' program); .95/(.4·41.2761)·6.341 = .3649.
TEST(Flip, OfGreysIsWorkedOutByHand) {
    for (const float error : flipErrors(grey(4, 3, 0.1f), grey(4, 3, 0.2f))) EXPECT_NEAR(error, 0.3649, 2e-4);
}

// By the authors' own C++ program, version 1.7 (single precision), from the same pixels.
TEST(Flip, AgreesWithTheAuthorsProgram) {
    const std::vector<float> errors = flipErrors(squares(false), squares(true));
    EXPECT_NEAR(mean(errors), 0.0614335706, 2e-6);
    EXPECT_NEAR(errors[0], 0.19884254, 2e-6);
    EXPECT_NEAR(errors[10 * 48 + 20], 0.0495591909, 2e-6);
    EXPECT_NEAR(errors[31 * 48 + 47], 0.0714734867, 2e-6);
    EXPECT_NEAR(errors[15 * 48 + 9], 0.0479764901, 2e-6);
}

TEST(Flip, ShowsWhatIsNotFinite) {
    Image broken = grey(3, 3, 0.2f);
    broken.pixels[4].y = std::numeric_limits<float>::infinity();
    for (const float error : flipErrors(broken, grey(3, 3, 0.2f))) {
        EXPECT_TRUE(std::isfinite(error));
        EXPECT_GT(error, 0);
    }
}

TEST(Flip, RefusesDifferentSizes) {
    test::expectError(ErrorCode::Usage, "one size", [] { flipErrors(grey(2, 1, 0), grey(1, 2, 0)); });
}
