#include "farm/jobs/block_pool.h"

#include <gtest/gtest.h>

#include "tests/support/dyadic.h"

using namespace antipode;

namespace {

BlockPool poolOf(const std::vector<IterationRange>& ranges) {
    BlockPool pool;
    for (const IterationRange& range : ranges) pool.add(range);
    return pool;
}

using Block = std::optional<IterationRange>;

}  // namespace

TEST(BlockPool, TakesTheLowestAlignedPlace) {
    BlockPool pool = poolOf({{0, 100}});
    EXPECT_EQ(pool.take(16, 100), (Block{{0, 16}}));
    EXPECT_EQ(pool.take(1, 100), (Block{{16, 1}}));
    EXPECT_EQ(pool.take(16, 100), (Block{{32, 16}}));  // 17 would do for a block of one only
    EXPECT_EQ(pool.take(2, 100), (Block{{17, 1}}));    // half as large is large enough
    EXPECT_EQ(pool.take(2, 100), (Block{{18, 2}}));
}

TEST(BlockPool, TakesASmallerBlockAtTheFrontWhereThereIsNoOther) {
    BlockPool pool = poolOf({{3, 5}});
    EXPECT_EQ(pool.take(8, 100), (Block{{3, 1}}));
    EXPECT_EQ(pool.take(8, 100), (Block{{4, 4}}));
    EXPECT_EQ(pool.take(8, 100), Block{});
}

TEST(BlockPool, StaysBelowTheEnd) {
    BlockPool pool = poolOf({{0, endOfTime}});
    EXPECT_EQ(pool.count(6), 6u);
    EXPECT_EQ(pool.take(8, 6), (Block{{0, 4}}));
    EXPECT_EQ(pool.take(8, 6), (Block{{4, 2}}));
    EXPECT_EQ(pool.take(8, 6), Block{});
    EXPECT_EQ(pool.take(8, endOfTime), (Block{{8, 8}}));
}

TEST(BlockPool, CutsUpEverythingIntoDyadicBlocks) {
    BlockPool pool = poolOf({{5, 9}, {20, 31}, {64, 7}});
    IterationSet taken;
    while (const Block block = pool.take(8, 100)) {
        EXPECT_TRUE(test::isDyadic(*block)) << block->first << "+" << block->count;
        EXPECT_FALSE(taken.intersects(*block));
        taken.add(*block);
    }
    EXPECT_EQ(taken, IterationSet({{5, 9}, {20, 31}, {64, 7}}));
}
