// numerics/half.h against every half and every point where rounding changes.
#include "numerics/half.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace antipode {
namespace {

/// The value of a finite half, or infinity, after IEEE 754.
double valueOf(uint16_t half) {
    const int exponent = (half >> 10) & 31, mantissa = half & 1023;
    const double magnitude = exponent == 31  ? std::numeric_limits<double>::infinity()
                             : exponent == 0 ? std::ldexp(mantissa, -24)
                                             : std::ldexp(1024 + mantissa, exponent - 25);
    return half & 0x8000 ? -magnitude : magnitude;
}

bool isNan(uint16_t half) { return (half & 0x7FFF) > 0x7C00; }

TEST(Half, EveryHalfSurvives) {
    for (uint32_t h = 0; h < 65536; ++h)
        if (!isNan(uint16_t(h))) {
            EXPECT_EQ(toHalf(float(valueOf(uint16_t(h)))), h);
        }
}

TEST(Half, RoundsToNearestEven) {
    for (uint32_t h = 0; h < 0x7BFF; ++h) {
        const auto low = uint16_t(h), high = uint16_t(h + 1);
        const auto middle = float((valueOf(low) + valueOf(high)) / 2);
        const uint16_t even = low & 1 ? high : low;
        for (const uint16_t sign : {0x0000, 0x8000}) {
            const float s = sign ? -1.0f : 1.0f;
            ASSERT_EQ(toHalf(s * middle), sign | even) << h;
            ASSERT_EQ(toHalf(s * std::nextafter(middle, 0.0f)), sign | low) << h;
            ASSERT_EQ(toHalf(s * std::nextafter(middle, 1e9f)), sign | high) << h;
        }
    }
}

TEST(Half, ValuesBeyondTheRange) {
    EXPECT_EQ(toHalf(65519.99f), 0x7BFF);
    EXPECT_EQ(toHalf(65520.0f), 0x7C00);
    EXPECT_EQ(toHalf(-1e30f), 0xFC00);
    EXPECT_EQ(toHalf(std::numeric_limits<float>::infinity()), 0x7C00);
    EXPECT_TRUE(isNan(toHalf(std::numeric_limits<float>::quiet_NaN())));
    EXPECT_EQ(toHalf(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_EQ(toHalf(-0.0f), 0x8000);
}

}  // namespace
}  // namespace antipode
