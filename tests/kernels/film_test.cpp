// lib/film.glsl: sums must be the exact integers, and what cannot be summed must be counted. Fixed seeds.
#include <cmath>
#include <limits>
#include <tuple>

#include "support/hard_case.h"
#include "support/random.h"
#include "support/statistics.h"
#include "techniques/sample_sets.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

using namespace shared;

constexpr int scaleExponent = 30;

class FilmTest : public DeviceTest {
protected:
    FilmTest() : harness(*device, PackedScene{}, job()) {}

    static JobParameters<double> job() {
        JobParameters<double> p;
        p.cameraUp.w = std::ldexp(1.0, scaleExponent);
        return p;
    }

    void expectSums(const std::string& difficulty, const std::vector<int64_t>& expected) {
        const std::vector<int64_t> sums = harness.film();
        double different = 0;
        for (size_t i = 0; i < expected.size(); ++i) different += sums.at(i) != expected[i];
        expectWithin({"Accumulation", difficulty, "sums that are not the exact integers", 0}, different,
                     device->info().name);
    }

    KernelHarness harness;
};

/// What a sample adds: one of the two multiples of 2^-S around it, the greater where its fraction is above the random
/// number.
int64_t counts(float value, uint32_t random) {
    const double scaled = std::abs(std::ldexp(double(value), scaleExponent)), whole = std::floor(scaled);
    const int64_t magnitude = int64_t(whole) + (std::floor((scaled - whole) * 0x1p32) > double(random) ? 1 : 0);
    return value < 0 ? -magnitude : magnitude;
}

TEST_F(FilmTest, AllMagnitudesAndSignsSumExactly) {
    Random random(1);
    ProbeData inputs;
    std::vector<int64_t> expected(192);
    for (int i = 0; i < 400000; ++i) {
        // From far below one count to 2^54 counts; sums of 2000 of them stay in 64 bits.
        const int exponent = int(random.index(90)) - 65;
        const float value = float(std::ldexp(random.uniform(-1, 1), exponent));
        const uint32_t channel = random.index(192);
        const uint32_t bits = random.index(UINT32_MAX);
        inputs.a.push_back({value, std::bit_cast<float>(channel), std::bit_cast<float>(bits), 0});
        expected[channel] += counts(value, bits);
    }
    harness.run(kernel_probes::film_probe(), inputs);
    expectSums("samples of either sign over 27 decades, 2000 a sum", expected);
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::Saturated), 0u);
}

// One value a channel, so that no error can cancel: around the carries of both words, and at halves.
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
        for (float sign : {1.0f, -1.0f})
            for (uint32_t bits : {0u, 0x7FFFFFFFu, 0x80000000u}) {
                const float value = sign * std::ldexp(s, -scaleExponent);
                inputs.a.push_back({value, std::bit_cast<float>(channel), std::bit_cast<float>(bits), 0});
                expected.at(channel++) = counts(value, bits);
            }
    harness.run(kernel_probes::film_probe(), inputs);
    expectSums("carries between both words of a sum, halves, the largest sample", expected);
}

// A million additions to one channel, by as many invocations that contend for it.
TEST_F(FilmTest, AMillionAdditionsToOneChannel) {
    constexpr uint32_t channel = 100;
    Random random(2);
    ProbeData inputs;
    std::vector<int64_t> expected(192);
    for (int i = 0; i < 1'000'000; ++i) {
        const float value = float(std::ldexp(random.uniform(-0.5, 1), int(random.index(40)) - scaleExponent));
        const uint32_t bits = random.index(UINT32_MAX);
        inputs.a.push_back({value, std::bit_cast<float>(channel), std::bit_cast<float>(bits), 0});
        expected[channel] += counts(value, bits);
    }
    harness.run(kernel_probes::film_probe(), inputs);
    expectSums("10^6 additions to one channel", expected);
}

// Null hypothesis: sums of rounded samples have the mean of the samples' own, however far these are below one unit,
// where rounding to the nearest would add nothing. Significance 0.01 over all sums (Šidák). Each has 350 or more
// expected roundings up: near enough to normal.
TEST_F(FilmTest, RoundingKeepsTheMean) {
    constexpr uint32_t pixels = 10, samplesEach = 1 << 17;
    ProbeData inputs;
    std::vector<double> units;
    for (uint32_t c = 0; c < pixels; ++c) units.push_back(std::ldexp(1.37, -int(c)));
    for (uint32_t i = 0; i < samplesEach; ++i)
        for (uint32_t c = 0; c < pixels; ++c)
            inputs.a.push_back(texel(Vec3f(float(std::ldexp(units[c], -scaleExponent))), c));
    DispatchParameters<float> push{};
    std::tie(push.randomKey0, push.randomKey1) = randomKeys(1, 1);  // those of a render's first iteration
    harness.run(kernel_probes::film_probe(), inputs, 1, push);
    const std::vector<int64_t> sums = harness.film();
    double smallestP = 1;
    for (size_t c = 0; c < units.size(); ++c) {
        EXPECT_EQ(sums[3 * c], sums[3 * c + 1]);  // grey stays grey
        EXPECT_EQ(sums[3 * c], sums[3 * c + 2]);
        const double fraction = units[c] - std::floor(units[c]), n = samplesEach;
        smallestP = std::min(smallestP, normalTwoSidedP((double(sums[3 * c]) - n * units[c]) /
                                                        std::sqrt(n * fraction * (1 - fraction))));
    }
    expectWithin({"Accumulation", "samples down to 1/374 of the film's unit", "largest −log₁₀ p of 10 sums' means",
                  -std::log10(sidak(0.01, units.size()))},
                 -std::log10(smallestP), device->info().name);
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
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::NonFinite), 9u);
    expectSums("NaN and infinite samples add nothing and are counted", std::vector<int64_t>(192));

    // Too large for the sum, in one channel each; the other channels count.
    const float huge = std::ldexp(4.7e18f, -scaleExponent);
    inputs.a = {texel(Vec3f{huge, 1, 1}, 5u), texel(Vec3f{1, -huge, 1}, 5u), texel(Vec3f{1, 1, 3e38f}, 5u)};
    harness.run(kernel_probes::film_probe(), inputs, 1);
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::Saturated), 3u);
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::Negative), 1u);
    std::vector<int64_t> expected(192);
    for (size_t c = 15; c < 18; ++c) expected[c] = 2 * counts(1, 0);
    expectSums("a sample too large for a sum adds nothing and is counted", expected);

    // Negative samples are counted, and summed.
    harness.clearFilm();
    inputs.a = {texel(Vec3f{-1, 2, -3}, 0u)};
    harness.run(kernel_probes::film_probe(), inputs, 1);
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::Negative), 2u);
    EXPECT_EQ(harness.film().front(), counts(-1, 0));
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::NonFinite), 9u);
}

// Sums that leave 64 bits, each at its last sample; those that reach the last whole number before are right.
TEST_F(FilmTest, SumsBeyond64BitsAreCountedWhereTheyLeave) {
    const float quarter = std::ldexp(1.0f, 61 - scaleExponent), below = std::nextafter(quarter, 0.0f);
    ProbeData inputs;
    std::vector<int64_t> expected(192);
    const auto add = [&](uint32_t channel, std::initializer_list<float> values) {
        for (const float value : values) {
            inputs.a.push_back({value, std::bit_cast<float>(channel), std::bit_cast<float>(0u), 0});
            expected[channel] = int64_t(uint64_t(expected[channel]) + uint64_t(counts(value, 0)));
        }
    };
    add(0, {quarter, quarter, quarter, below});                                // 2^63 − 2^37
    add(1, {-quarter, -quarter, -quarter, -quarter});                          // −2^63
    add(2, {quarter, quarter, quarter, quarter});                              // 2^63: leaves
    add(3, {-quarter, -quarter, -quarter, -quarter, -1});                      // leaves
    for (int i = 0; i < 5; ++i) add(4, {quarter, quarter, quarter, quarter});  // 2.5·2^64: leaves three times
    harness.run(kernel_probes::film_probe(), inputs);
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::SumOverflow), 5u);
    EXPECT_EQ(harness.events(EventSource::Film, EventKind::Saturated), 0u);
    expectSums("sums at and beyond the ends of 64 bits, modulo 2^64", expected);
}

}  // namespace
}  // namespace antipode
