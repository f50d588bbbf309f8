#include "farm/jobs/iteration_set.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random.h"

using namespace antipode;

namespace {

using Bits = std::vector<bool>;

std::vector<IterationRange> runs(const Bits& bits, bool value, uint64_t first, uint64_t end) {
    std::vector<IterationRange> result;
    for (uint64_t i = first; i < end; ++i) {
        if (bits[i] != value) continue;
        if (!result.empty() && result.back().end() == i)
            ++result.back().count;
        else
            result.push_back({i, 1});
    }
    return result;
}

}  // namespace

TEST(IterationSet, EmptyRangesChangeNothing) {
    IterationSet set({{5, 0}, {0, 0}});
    EXPECT_TRUE(set.empty());
    set.add({4, 2});
    set.remove({5, 0});
    EXPECT_EQ(set, IterationSet({{4, 2}}));
    EXPECT_TRUE(set.contains({9, 0}));
    EXPECT_FALSE(set.intersects({5, 0}));
}

TEST(IterationSet, NeighboursBecomeOneRange) {
    const IterationSet set({{4, 4}, {0, 2}, {2, 2}});
    EXPECT_EQ(set.ranges(), (std::vector<IterationRange>{{0, 8}}));
    EXPECT_EQ(set.prefix(), 8u);
}

TEST(IterationSet, HoldsRangesFarOut) {
    constexpr uint64_t far = uint64_t(1) << 62;
    IterationSet set({{0, far}});
    set.remove({64, 64});
    EXPECT_EQ(set.count(), far - 64);
    EXPECT_EQ(set.end(), far);
    EXPECT_EQ(set.prefix(), 64u);
}

TEST(IterationSet, AgreesWithABitmap) {
    for (uint64_t seed = 1; seed <= 300; ++seed) {
        constexpr uint32_t size = 60;
        Random random(seed);
        IterationSet set;
        Bits bits(size);
        for (int step = 0; step < 60; ++step) {
            const uint64_t first = random.index(size), count = random.index(uint32_t(size - first + 1));
            const IterationRange range{first, count};
            const bool adds = random.uniform() < 0.5;
            adds ? set.add(range) : set.remove(range);
            for (uint64_t i = first; i < range.end(); ++i) bits[i] = adds;

            ASSERT_EQ(set.ranges(), runs(bits, true, 0, size)) << "seed " << seed << ", step " << step;
            const uint64_t from = random.index(size), length = random.index(uint32_t(size - from + 1));
            const IterationRange probe{from, length};
            const auto inside = std::count(bits.begin() + long(from), bits.begin() + long(probe.end()), true);
            ASSERT_EQ(set.contains(probe), uint64_t(inside) == length) << "seed " << seed << ", step " << step;
            ASSERT_EQ(set.intersects(probe), inside > 0) << "seed " << seed << ", step " << step;
            ASSERT_EQ(set.missing(probe), runs(bits, false, from, probe.end())) << "seed " << seed;
            ASSERT_EQ(set.gaps(from), runs(bits, false, 0, from)) << "seed " << seed << ", step " << step;
            ASSERT_EQ(set.count(), uint64_t(std::count(bits.begin(), bits.end(), true)));
            const auto zero = std::find(bits.begin(), bits.end(), false);
            ASSERT_EQ(set.prefix(), uint64_t(zero - bits.begin()));
            ASSERT_EQ(set, IterationSet(runs(bits, true, 0, size)));
        }
    }
}
