#include "gpu/bvh.h"

#include "support/hard_case.h"
#include "tests/gpu/bvh_check.h"
#include "renderengine/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iostream>
#include <limits>
#include <random>

namespace antipode {
namespace {

/// Boxes of the size of `extent` at most, in the unit cube.
std::vector<Bounds3f> randomBoxes(size_t count, float extent, uint32_t seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> place(0.0f, 1.0f), size(0.0f, extent);
    std::vector<Bounds3f> boxes(count);
    for (Bounds3f& box : boxes) {
        box.lower = {place(generator), place(generator), place(generator)};
        box.upper = box.lower + Vec3f(size(generator), size(generator), size(generator));
    }
    return boxes;
}

BvhFacts expectSound(const Bvh& bvh, const std::vector<Bounds3f>& triangles, const std::vector<Bounds3f>& spheres) {
    const BvhFacts facts = inspect(bvh, triangles, spheres);
    for (const std::string& fault : facts.faults) ADD_FAILURE() << fault;
    EXPECT_EQ(facts.timesInLeaf, std::vector<uint32_t>(triangles.size() + spheres.size(), 1u));
    EXPECT_EQ(bvh.primitiveOrder.size(), triangles.size() + spheres.size());
    EXPECT_EQ(bvh.stackDepth, facts.deepestStack);
    EXPECT_LE(facts.largestLeaf, Bvh::maxLeafSize);
    EXPECT_GE(bvh.buildSeconds, 0.0);
    return facts;
}

BvhFacts expectSound(const std::vector<Bounds3f>& triangles, const std::vector<Bounds3f>& spheres) {
    return expectSound(buildBvh(triangles, spheres), triangles, spheres);
}

void expectNoFaults(const std::string& difficulty, const BvhFacts& facts) {
    expectWithin({"Intersection", difficulty, "boxes of the hierarchy that do not hold what is below them", 0},
                 double(facts.faults.size()));
}

bool sameBits(const Bvh& a, const Bvh& b) {
    return a.nodes.size() == b.nodes.size() && a.primitiveOrder == b.primitiveOrder && a.stackDepth == b.stackDepth &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof a.nodes[0]) == 0;
}

TEST(Bvh, OfNothingIsAnEmptyRoot) {
    const Bvh bvh = buildBvh({}, {});
    expectSound(bvh, {}, {});
    EXPECT_EQ(bvh.nodes.size(), Bvh::texelsPerNode);
    EXPECT_EQ(bvh.stackDepth, 0u);
}

TEST(Bvh, OfOnePrimitiveHasAnInnerRoot) {
    const std::vector<Bounds3f> one = {{{1, 2, 3}, {4, 5, 6}}};
    for (const bool sphere : {false, true}) {
        const Bvh bvh = sphere ? buildBvh({}, one) : buildBvh(one, {});
        const BvhFacts facts = sphere ? expectSound(bvh, {}, one) : expectSound(bvh, one, {});
        EXPECT_EQ(facts.leaves, 1u);
        EXPECT_EQ(bvh.nodes.size(), Bvh::texelsPerNode);
        EXPECT_EQ(bvh.nodes[0][0], 1.0f);
        EXPECT_EQ(bvh.nodes[5][0], 6.0f);
        EXPECT_EQ(bvh.stackDepth, 0u);
    }
}

TEST(Bvh, SmallSetsOfEverySize) {
    for (size_t count = 1; count <= 40; ++count) {
        SCOPED_TRACE(count);
        expectSound(randomBoxes(count, 0.1f, 1), {});
        expectSound(randomBoxes(count, 0.1f, 2), randomBoxes(41 - count, 0.2f, 3));
    }
}

TEST(Bvh, PartsKindsThatShareAPlace) {
    const std::vector<Bounds3f> same(3, {{0, 0, 0}, {1, 1, 1}});
    const BvhFacts facts = expectSound(same, same);
    EXPECT_EQ(facts.leaves, 2u);
}

TEST(Bvh, IdenticalBoxesAndPoints) {
    const std::vector<Bounds3f> boxes(10001, {{1, 1, 1}, {2, 2, 2}}), points(1001, {{5, 5, 5}, {5, 5, 5}});
    const BvhFacts facts = expectSound(boxes, points);
    expectNoFaults("10⁴ identical boxes, 10³ identical points", facts);
    EXPECT_EQ(facts.largestLeaf, Bvh::maxLeafSize);
    EXPECT_LE(facts.depth, 9u) << "cut by count, 1251 leaves need six levels";
}

TEST(Bvh, ConcentricShellsAreCutBySize) {
    std::vector<Bounds3f> shells;
    for (int i = 1; i <= 1000; ++i) shells.push_back({Vec3f(-float(i)), Vec3f(float(i))});
    std::shuffle(shells.begin(), shells.end(), std::mt19937(4));
    const Bvh bvh = buildBvh(shells, {});
    expectSound(bvh, shells, {});
    // The leaf that the smallest shell is in holds none of the larger ones.
    size_t small = 0;
    for (uint32_t first = 0; first < 8; ++first) small += shells[bvh.primitiveOrder[first]].upper.x <= 8.0f;
    EXPECT_EQ(small, 8u);
}

TEST(Bvh, SizesFarApart) {
    std::vector<Bounds3f> boxes;
    for (int exponent = -120; exponent <= 59; ++exponent) {
        const float x = std::ldexp(1.0f, exponent);
        for (const float sign : {-1.0f, 1.0f})
            boxes.push_back({Vec3f(std::min(sign * x, sign * x * 1.5f)), Vec3f(std::max(sign * x, sign * x * 1.5f))});
    }
    boxes.push_back({Vec3f(-1e18f), Vec3f(1e18f)});
    const BvhFacts facts = expectSound(boxes, {});
    expectNoFaults("boxes of sizes from 2⁻¹²⁰ to 2⁵⁹", facts);
    EXPECT_LE(facts.depth, 72u);
}

TEST(Bvh, FlatGridOnAPlane) {
    std::vector<Bounds3f> cells;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
            for (int half = 0; half < 2; ++half)  // the two triangles of a square have one box
                cells.push_back({{float(x), float(y), 0}, {float(x + 1), float(y + 1), 0}});
    expectSound(cells, {});
}

TEST(Bvh, DoesNotDependOnThreads) {
    std::vector<Bounds3f> triangles = randomBoxes(60000, 0.02f, 5), spheres = randomBoxes(20000, 0.02f, 6);
    // What order could decide: copies of a box, boxes with one centre, and a crowd of both.
    for (int i = 0; i < 5000; ++i) {
        triangles.push_back(triangles[i]);
        spheres.push_back(triangles[i]);
        triangles.push_back({Vec3f(0.5f - float(i % 70) * 0x1p-8f), Vec3f(0.5f + float(i % 70) * 0x1p-8f)});
    }
    std::shuffle(triangles.begin(), triangles.end(), std::mt19937(8));
    const Bvh reference = buildBvh(triangles, spheres, 1);
    expectSound(reference, triangles, spheres);
    for (int run = 0; run < 5; ++run) EXPECT_TRUE(sameBits(reference, buildBvh(triangles, spheres, 2))) << run;
}

TEST(Bvh, AMillionTriangles) {
    const std::vector<Bounds3f> triangles = randomBoxes(1000000, 0.01f, 7);
    const Bvh bvh = buildBvh(triangles, {});
    const BvhFacts facts = expectSound(bvh, triangles, {});
    std::cout << "built in " << bvh.buildSeconds << " s (" << 1e-6 * double(triangles.size()) / bvh.buildSeconds
              << " million triangles a second), " << bvh.nodes.size() / Bvh::texelsPerNode << " nodes, "
              << double(triangles.size()) / facts.leaves << " triangles a leaf, depth " << facts.depth << ", stack "
              << bvh.stackDepth << "\n";
    EXPECT_LT(bvh.nodes.size() / Bvh::texelsPerNode, triangles.size());
    EXPECT_LE(facts.depth, 24u);
}

TEST(Bvh, RefusesInvalidBounds) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::vector<Bounds3f> bad = {
        {{0, 0, 0}, {1, -1, 1}}, {{0, nan, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, infinity}}, {{-2e18f, 0, 0}, {0, 0, 0}}};
    for (const Bounds3f& box : bad) {
        const std::vector<Bounds3f> boxes = {{{0, 0, 0}, {1, 1, 1}}, box};
        EXPECT_THROW(buildBvh(boxes, {}), Error);
        EXPECT_THROW(buildBvh({}, boxes), Error);
    }
}

}  // namespace
}  // namespace antipode
