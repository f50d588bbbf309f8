// lib/random.glsl: numbers and pairs of neighbours are uniform. Null hypothesis of every test: independent uniform
// numbers. Significance 0.01 over all tests of a case (Šidák); seeds fixed.
#include <cmath>

#include "support/statistics.h"
#include "tests/kernels/random_fixture.h"

namespace antipode {
namespace {

class RandomTest : public RandomFixture {
protected:
    /// One block a call of `address`.
    std::vector<Texel> blocks(size_t count, const std::function<Address(uint32_t)>& address, uint64_t seed = 1,
                              uint64_t iteration = 1) {
        const auto [key0, key1] = randomKeys(seed, iteration);
        return draw(0, count, address, {key0, key1, 0});
    }
};

constexpr size_t samples = 1u << 19;
constexpr uint32_t lightStream = 0x9E3779B9;  // RANDOM_LIGHT
const std::array<float Texel::*, 4> components{&Texel::x, &Texel::y, &Texel::z, &Texel::w};

/// p-values of one number of `a` with one of `b`: χ² of the pairs on a 32 × 32 grid, and their linear correlation.
std::array<double, 2> pairTests(const std::vector<Texel>& a, float Texel::*first, const std::vector<Texel>& b,
                                float Texel::*second) {
    constexpr int bins = 32;
    std::vector<double> observed(bins * bins), expected(bins * bins, double(a.size()) / (bins * bins));
    double covariance = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        const double x = double(a[i].*first), y = double(b[i].*second);
        ++observed[size_t(x * bins) * bins + size_t(y * bins)];
        covariance += (x - 0.5) * (y - 0.5);
    }
    const double z = covariance * 12 / std::sqrt(double(a.size()));
    return {chiSquareTest(observed, expected).pValue, normalTwoSidedP(z)};
}

TEST_F(RandomTest, NumbersAreUniformAndBelowOne) {
    const double significance = sidak(0.01, 4 * 4);
    float least = 1, greatest = 0;
    for (uint64_t iteration : {1ull, 2ull, 1000000ull, 1ull << 40}) {
        const auto numbers = blocks(
            1u << 20, [](uint32_t i) { return Address{.path = i}; }, 1, iteration);
        for (const auto component : components) {
            std::vector<double> observed(4096), expected(4096, double(numbers.size()) / 4096);
            for (const Texel& t : numbers) {
                const float u = t.*component;
                least = std::min(least, u);
                greatest = std::max(greatest, u);
                ASSERT_TRUE(u >= 0 && u < 1);
                ++observed[size_t(u * 4096)];
            }
            expectNull("random numbers of iterations 1, 2, 10⁶ and 2⁴⁰", significance,
                       chiSquareTest(observed, expected).pValue);
        }
    }
    // 2^24 draws: the least and the greatest multiple of 2^-24 are 0 and 1 − 2^-24; the ends are all but reached.
    EXPECT_LE(greatest, 1 - 0x1p-24f);
    EXPECT_GT(greatest, 1 - 30 * 0x1p-24f);
    EXPECT_LT(least, 30 * 0x1p-24f);
}

TEST_F(RandomTest, NeighboursAreIndependent) {
    const auto byPath = [](uint32_t i) { return Address{.path = i}; };
    const auto original = blocks(samples, byPath);
    struct Case {
        const char* name;
        std::vector<Texel> numbers;
    };
    const Case cases[] = {
        {"next path", blocks(samples, [](uint32_t i) { return Address{.path = i + 1}; })},
        {"path 2^16 on", blocks(samples, [](uint32_t i) { return Address{.path = i + 65536}; })},
        {"next block", blocks(samples, [](uint32_t i) { return Address{.path = i, .block = 3}; })},
        {"next vertex", blocks(samples, [](uint32_t i) { return Address{.path = i, .vertex = 2}; })},
        {"light path", blocks(samples, [](uint32_t i) { return Address{.path = i, .stream = lightStream}; })},
        {"light path's next vertex",
         blocks(samples, [](uint32_t i) { return Address{.path = i, .stream = lightStream, .vertex = 2}; })},
        {"next iteration", blocks(samples, byPath, 1, 2)},
        {"next seed", blocks(samples, byPath, 2, 1)},
        {"iteration for seed", blocks(samples, byPath, 0, 2)},
    };
    // All pairs of components with each neighbour, two tests a pair; and the pairs within a block.
    const double significance = sidak(0.01, std::size(cases) * 16 * 2 + 6 * 2);
    const std::string difficulty = "pairs with the next path, vertex, block, stream, iteration and seed";
    const auto indexOf = [&](float Texel::*c) {
        return std::find(components.begin(), components.end(), c) - components.begin();
    };
    for (const Case& c : cases)
        for (const auto first : components)
            for (const auto second : components)
                for (double p : pairTests(original, first, c.numbers, second)) {
                    SCOPED_TRACE(testing::Message()
                                 << c.name << ", numbers " << indexOf(first) << " and " << indexOf(second));
                    expectNull(difficulty, significance, p);
                }
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = i + 1; j < 4; ++j)
            for (double p : pairTests(original, components[i], original, components[j])) {
                SCOPED_TRACE(testing::Message() << i << j);
                expectNull(difficulty, significance, p);
            }
}

// Along one path: consecutive blocks and vertices are the next numbers of a sampler, for which short series must do.
TEST_F(RandomTest, SeriesAlongPathsAreUniform) {
    const auto numbers =
        blocks(samples, [](uint32_t i) { return Address{.path = i / 512, .vertex = (i / 32) % 16, .block = i % 32}; });
    std::vector<Texel> next(numbers.begin() + 1, numbers.end());
    next.push_back(numbers.front());
    const double significance = sidak(0.01, 4 * 2);
    for (const auto component : components)
        for (double p : pairTests(numbers, component, next, component))
            expectNull("consecutive numbers along a path", significance, p);
}

/// Index i has the values from ⌈i·2^32/count⌉ on, so that no two indices' shares differ by more than one of them; with
/// 24 bits half of twelve million things would be drawn twice as often as the others.
TEST_F(RandomTest, IndicesHaveEqualSharesOfAllValues) {
    ProbeData inputs;
    std::vector<uint32_t> expected;
    const auto add = [&](uint64_t bits, uint32_t count, uint64_t index) {
        inputs.a.push_back({std::bit_cast<float>(uint32_t(bits)), std::bit_cast<float>(count), 0, 0});
        expected.push_back(uint32_t(index));
    };
    for (uint32_t count : {1u, 3u, 1000u, (1u << 24) - 1, 12'000'001u, 0x7FFFFFFFu, 0xFFFFFFFFu})
        for (uint64_t k = 0; k < 4096; ++k) {
            const uint64_t index = k * (count - 1) / 4095, first = ((index << 32) + count - 1) / count;
            add(first, count, index);
            if (index > 0) add(first - 1, count, index - 1);
        }
    const ProbeData outputs = harness.run(kernel_probes::random_probe(), inputs, 1);
    uint64_t wrong = 0;
    for (size_t i = 0; i < expected.size(); ++i) wrong += bitsOf(outputs.a[i].x) != expected[i];
    EXPECT_GT(expected.size(), 40'000u);
    expectWithin({"Sampling", "one of up to 2³² things by 32 random bits", "values that give another index", 0},
                 double(wrong), device->info().name);
}

}  // namespace
}  // namespace antipode
