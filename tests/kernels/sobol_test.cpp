// Sobol' numbers (lib/random.glsl, lib/sobol.glsl): every aligned dyadic run of indices is a net, whatever the
// scrambling, and over scramblings each point is uniform and independent of the points of other dimensions.
//
// Null hypothesis of the statistical tests: independent uniform numbers. Significance 0.01 over all tests of a case
// (Šidák); seeds fixed.
#include <cmath>

#include "support/statistics.h"
#include "tests/kernels/random_fixture.h"

namespace antipode {
namespace {

constexpr uint32_t cameraStream = 0, lightStream = 0x9E3779B9;  // RANDOM_LIGHT
constexpr size_t scramblings = 1u << 19;

class SobolTest : public RandomFixture {
protected:
    /// A point a call of `address`, of the iteration that stands at `index` in the set of this number.
    std::vector<Texel> points(size_t count, uint32_t index, const std::function<Address(uint32_t)>& address,
                              uint64_t set = 1) {
        const auto [key0, key1] = randomKeys(1, set);
        return draw(2, count, address, {key0, key1, index});
    }
};

/// Whether 2^m points of these dimensions are a (t,m,s)-net in base 2: every box of 2^(t−m) of the volume, cut into
/// dyadic parts, holds 2^t of them (Niederreiter 1992, definition 4.1).
bool isNet(const std::vector<std::array<float, 4>>& points, uint32_t dimensions, uint32_t t) {
    const uint32_t cuts =
        uint32_t(std::countr_zero(points.size())) - std::min(t, uint32_t(std::countr_zero(points.size())));
    for (uint32_t shape = 0; shape < 1u << (4 * dimensions); ++shape) {
        uint32_t digits = 0;
        for (uint32_t d = 0; d < dimensions; ++d) digits += shape >> 4 * d & 15;
        if (digits != cuts) continue;
        std::vector<uint32_t> held(size_t(1) << cuts, 0);
        for (const auto& point : points) {
            uint32_t box = 0;
            for (uint32_t d = 0; d < dimensions; ++d) {
                const uint32_t own = shape >> 4 * d & 15;
                box = box << own | uint32_t(std::ldexp(point[d], int(own)));
            }
            ++held[box];
        }
        for (const uint32_t count : held)
            if (count != points.size() >> cuts) return false;
    }
    return true;
}

std::array<float, 4> coordinates(const Texel& t) { return {t.x, t.y, t.z, t.w}; }

/// Two dimensions are (0,m,2)-nets, three (1,m,3)-nets, four (3,m,4)-nets.
void expectNets(const std::vector<std::array<float, 4>>& points) {
    EXPECT_TRUE(isNet(points, 2, 0));
    EXPECT_TRUE(isNet(points, 3, 1));
    EXPECT_TRUE(isNet(points, 4, 3));
}

TEST_F(SobolTest, LightPathsOfAnAlignedRunAreNets) {
    for (const uint32_t size : {1u, 2u, 16u, 64u, 256u})
        for (const uint32_t run : {0u, 1u, 2u, 5u, 1000u, 0xFFFFFFFFu / size})
            for (const uint32_t block : {0u, 1u, 2u}) {
                SCOPED_TRACE(testing::Message() << size << " points, run " << run << ", block " << block);
                std::vector<std::array<float, 4>> net;
                for (const Texel& t : points(size, 0, [&](uint32_t i) {
                         return Address{.path = size * run + i, .stream = lightStream, .vertex = 0, .block = block};
                     }))
                    net.push_back(coordinates(t));
                expectNets(net);
            }
}

TEST_F(SobolTest, IterationsOfAnAlignedRunAreNetsInEveryPixel) {
    constexpr uint32_t pixels = 64;
    for (const auto& [first, size] :
         {std::pair(0u, 64u), std::pair(64u, 64u), std::pair(48u, 16u), std::pair(6u, 2u)}) {
        std::vector<std::vector<std::array<float, 4>>> nets(pixels);
        for (uint32_t index = first; index < first + size; ++index) {
            const auto numbers = points(pixels, index, [](uint32_t i) { return Address{.path = i}; });
            for (uint32_t p = 0; p < pixels; ++p) nets[p].push_back(coordinates(numbers[p]));
        }
        for (uint32_t p = 0; p < pixels; ++p) {
            SCOPED_TRACE(testing::Message() << "iterations from " << first << ", pixel " << p);
            expectNets(nets[p]);
        }
    }
}

/// That isNet() can say no: the same points with one coordinate of one of them elsewhere, and of another run.
TEST_F(SobolTest, WhatIsNoNetIsTold) {
    const auto from = [](uint32_t first) {
        return [=](uint32_t i) { return Address{.path = first + i, .stream = lightStream}; };
    };
    std::vector<std::array<float, 4>> net, across;
    for (const Texel& t : points(64, 0, from(0))) net.push_back(coordinates(t));
    for (const Texel& t : points(64, 0, from(40))) across.push_back(coordinates(t));
    EXPECT_TRUE(isNet(net, 2, 0));
    net[5][1] = net[5][1] < 0.5f ? net[5][1] + 0.5f : net[5][1] - 0.5f;
    EXPECT_FALSE(isNet(net, 2, 0));
    EXPECT_FALSE(isNet(across, 2, 0)) << "64 indices from 40 on are no aligned run";
}

const std::array<float Texel::*, 4> components{&Texel::x, &Texel::y, &Texel::z, &Texel::w};

double uniformP(const std::vector<Texel>& numbers, float Texel::*component, uint32_t bins) {
    std::vector<double> observed(bins), expected(bins, double(numbers.size()) / bins);
    for (const Texel& t : numbers) ++observed[size_t(t.*component * float(bins))];
    return chiSquareTest(observed, expected).pValue;
}

double pairP(const std::vector<Texel>& a, float Texel::*first, const std::vector<Texel>& b, float Texel::*second) {
    constexpr int bins = 32;
    std::vector<double> observed(bins * bins), expected(bins * bins, double(a.size()) / (bins * bins));
    for (size_t i = 0; i < a.size(); ++i) ++observed[size_t(a[i].*first * bins) * bins + size_t(b[i].*second * bins)];
    return chiSquareTest(observed, expected).pValue;
}

/// Each pixel is a scrambling. 256 bins: the first eight digits, which the hash of the seed has to make uniform.
TEST_F(SobolTest, EveryPointIsUniformOverScramblings) {
    constexpr std::array indices{0u, 1u, 2u, 3u, 7u, 100u, 0x12345678u, 0xFFFFFFFFu};
    const double significance = sidak(0.01, indices.size() * 4 * 2);
    for (const uint32_t index : indices) {
        const auto numbers = points(scramblings, index, [](uint32_t i) { return Address{.path = i}; });
        for (const auto component : components)
            for (const uint32_t bins : {256u, 4096u})
                expectNull("points of scrambled nets, 2¹⁹ scramblings", significance,
                           uniformP(numbers, component, bins));
    }
}

/// Dimensions of a point, and blocks of a path, which are scrambled and shuffled apart.
TEST_F(SobolTest, DimensionsAndBlocksAreIndependent) {
    const auto of = [&](uint32_t index, const Address& a, uint64_t set = 1) {
        return points(
            scramblings, index,
            [&](uint32_t i) {
                return Address{a.path + i, a.stream, a.vertex, a.block};
            },
            set);
    };
    constexpr std::array indices{0u, 1u, 6u};
    const double significance = sidak(0.01, indices.size() * (6 + 6 * 16));
    for (const uint32_t index : indices) {
        const std::vector<Texel> original = of(index, {});
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = i + 1; j < 4; ++j)
                expectNull("dimensions of a point", significance,
                           pairP(original, components[i], original, components[j]));
        const std::vector<Texel> others[] = {of(index, {.path = 1}),   of(index, {.block = 3}),
                                             of(index, {.vertex = 2}), of(index, {.path = 65536}),
                                             of(index, {.vertex = 0}), of(index, {}, 2)};
        for (const auto& other : others)
            for (const auto first : components)
                for (const auto second : components)
                    expectNull("next pixel, block, vertex and set of a scrambled net", significance,
                               pairP(original, first, other, second));
    }
}

/// Two points of a sequence lie in different halves as its digits say, and are uniform beyond: of 0 and 1 in each
/// dimension, the sum of the places within halves is that of independent numbers.
TEST_F(SobolTest, NeighboursOfASequenceAreStratifiedAndElseIndependent) {
    const auto byPixel = [](uint32_t i) { return Address{.path = i}; };
    auto a = points(scramblings, 0, byPixel), b = points(scramblings, 1, byPixel);
    const double significance = sidak(0.01, 4);
    for (const auto component : components) {
        size_t together = 0;
        for (size_t i = 0; i < a.size(); ++i) {
            together += (a[i].*component < 0.5f) == (b[i].*component < 0.5f);
            a[i].*component = std::fmod(2 * a[i].*component, 1.0f);
            b[i].*component = std::fmod(2 * b[i].*component, 1.0f);
        }
        EXPECT_EQ(together, 0u);
        expectNull("places of neighbours within their halves", significance, pairP(a, component, b, component));
    }
}

}  // namespace
}  // namespace antipode
