// lib/film.glsl: sums must be the exact integers, and what cannot be summed must be counted. Fixed seeds.
#include <cmath>
#include <limits>

#include "support/random.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

using namespace shared;

constexpr int scaleExponent = 30;

class FilmTest : public DeviceTest {
protected:
    FilmTest() : harness(*device, PackedScene{}, job()) {}

    static JobParameters job() {
        JobParameters p;
        p.cameraUp.w = float(std::ldexp(1.0, scaleExponent));
        return p;
    }

    KernelHarness harness;
};

/// What a sample adds: its nearest integer multiple of 2^-S, ties to even.
int64_t counts(float value) { return std::llrint(std::ldexp(double(value), scaleExponent)); }

TEST_F(FilmTest, AllMagnitudesAndSignsSumExactly) {
    Random random(1);
    ProbeData inputs;
    std::vector<int64_t> expected(192);
    for (int i = 0; i < 400000; ++i) {
        // From far below one count to 2^54 counts; sums of 2000 of them stay in 64 bits.
        const int exponent = int(random.index(90)) - 65;
        const float value = float(std::ldexp(random.uniform(-1, 1), exponent));
        const uint32_t channel = random.index(192);
        inputs.a.push_back({value, std::bit_cast<float>(channel), 0, 0});
        expected[channel] += counts(value);
    }
    harness.run(kernel_probes::film_probe(), inputs);
    EXPECT_EQ(harness.film(), expected);
    EXPECT_EQ(harness.counter(COUNTER_SATURATED), 0u);
}

// One value a channel, so that no error can cancel: around the carries of both words, and at ties.
TEST_F(FilmTest, EveryEdgeAlone) {
    std::vector<float> scaled{0.0f, -0.0f, 0.25f, 0.5f, 0.75f, 1.0f, 1.5f, 2.5f, 8388607.5f, 8388608.0f, 16777215.0f};
    for (int e : {31, 32, 33, 40, 61})
        for (float v : {std::ldexp(1.0f, e), std::nextafter(std::ldexp(1.0f, e), 0.0f),
                        std::nextafter(std::ldexp(1.0f, e), 1e30f)})
            scaled.push_back(v);
    scaled.push_back(4.5e18f);
    ProbeData inputs;
    std::vector<int64_t> expected(192);
    uint32_t channel = 0;
    for (float s : scaled)
        for (float sign : {1.0f, -1.0f}) {
            const float value = sign * std::ldexp(s, -scaleExponent);
            inputs.a.push_back({value, std::bit_cast<float>(channel), 0, 0});
            expected.at(channel++) = counts(value);
        }
    harness.run(kernel_probes::film_probe(), inputs);
    EXPECT_EQ(harness.film(), expected);
}

TEST_F(FilmTest, WhatCannotBeSummedIsCounted) {
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    ProbeData inputs;
    for (float bad : {inf, -inf, nan})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3f value(1);
            value[axis] = bad;
            inputs.a.push_back(texel(value, 5u));
        }
    harness.run(kernel_probes::film_probe(), inputs, 1);
    EXPECT_EQ(harness.counter(COUNTER_NON_FINITE), 9u);
    EXPECT_EQ(harness.film(), std::vector<int64_t>(192)) << "a sample that is counted as bad must add nothing";

    // Too large for the sum, in one channel each; the other channels count.
    const float huge = std::ldexp(4.7e18f, -scaleExponent);
    inputs.a = {texel(Vec3f{huge, 1, 1}, 5u), texel(Vec3f{1, -huge, 1}, 5u), texel(Vec3f{1, 1, 3e38f}, 5u)};
    harness.run(kernel_probes::film_probe(), inputs, 1);
    EXPECT_EQ(harness.counter(COUNTER_SATURATED), 3u);
    EXPECT_EQ(harness.counter(COUNTER_NEGATIVE), 1u);
    std::vector<int64_t> expected(192);
    for (size_t c = 15; c < 18; ++c) expected[c] = 2 * counts(1);
    EXPECT_EQ(harness.film(), expected);

    // Negative samples are counted, and summed.
    harness.clearFilm();
    inputs.a = {texel(Vec3f{-1, 2, -3}, 0u)};
    harness.run(kernel_probes::film_probe(), inputs, 1);
    EXPECT_EQ(harness.counter(COUNTER_NEGATIVE), 2u);
    EXPECT_EQ(harness.film().front(), counts(-1));
    EXPECT_EQ(harness.counter(COUNTER_NON_FINITE), 9u);
}

}  // namespace
}  // namespace antipode
