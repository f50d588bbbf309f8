#include <limits>

#include "renderengine/film.h"
#include "tests/film/expect_error.h"

using namespace antipode;
using test::expectError;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST(CompareImages, MatchesValuesWorkedOutByHand) {
    const Image a{2, 1, {{1, 2, 3}, {0, 0, 0.5f}}}, b{2, 1, {{1, 1, 1}, {0, 0, 0}}};
    const ImageComparison result = compareImages(a, b);
    EXPECT_EQ(result.meanA, Vec3d(0.5, 1, 1.75));
    EXPECT_EQ(result.meanB, Vec3d(0.5, 0.5, 0.5));
    EXPECT_EQ(result.ratio, Vec3d(1, 2, 3.5));
    // Squared errors 0, 1, 4 | 0, 0, 0.25; divided by b² + 0.01 = 1.01 (three times) and 0.01 (three times).
    EXPECT_DOUBLE_EQ(result.rmse, std::sqrt(5.25 / 6));
    EXPECT_DOUBLE_EQ(result.relMse, (5 / 1.01 + 0.25 / 0.01) / 6);
    ASSERT_EQ(result.worst.size(), 2u);
    EXPECT_EQ(result.worst[0].x, 1u);
    EXPECT_EQ(result.worst[0].y, 0u);
    EXPECT_DOUBLE_EQ(result.worst[0].relativeSquaredError, 25.0 / 3);
    EXPECT_DOUBLE_EQ(result.worst[1].relativeSquaredError, 5 / 1.01 / 3);
    EXPECT_EQ(result.worst[0].a, a.pixels[1]);
    EXPECT_EQ(result.worst[0].b, b.pixels[1]);
}

TEST(CompareImages, EqualImagesHaveNoError) {
    const Image a{1, 2, {{1, 2, 3}, {0, 0, 0}}};
    const ImageComparison result = compareImages(a, a);
    EXPECT_EQ(result.rmse, 0);
    EXPECT_EQ(result.relMse, 0);
    EXPECT_TRUE(result.worst.empty());
}

TEST(CompareImages, LeavesNonFinitePixelsOutAndCountsThem) {
    const Image a{4, 1, {{infinity, 0, 0}, {1, 1, 1}, {2, 2, 2}, {-1, -2, 0}}};
    const Image b{4, 1, {{1, 1, 1}, {1, std::nanf(""), 1}, {1, 1, 1}, {0, 0, -1}}};
    const ImageComparison result = compareImages(a, b);
    EXPECT_EQ(result.nonFiniteA, 1u);
    EXPECT_EQ(result.nonFiniteB, 1u);
    EXPECT_EQ(result.negativeA, 1u);
    EXPECT_EQ(result.negativeB, 1u);
    EXPECT_EQ(result.meanA, Vec3d(0.5, 0, 1));
    EXPECT_EQ(result.meanB, Vec3d(0.5, 0.5, 0));
    EXPECT_DOUBLE_EQ(result.rmse, std::sqrt((3 + 1 + 4 + 1) / 6.0));
}

TEST(CompareImages, NoFinitePixelGivesNoMean) {
    const Image a{1, 1, {{infinity, 0, 0}}}, b{1, 1, {{0, 0, 0}}};
    const ImageComparison result = compareImages(a, b);
    EXPECT_TRUE(std::isnan(result.meanA.x));
    EXPECT_TRUE(std::isnan(result.relMse));
}

TEST(CompareImages, WorstPixelsAreTheTenWorstInOrder) {
    Image a{5, 4, std::vector<Vec3f>(20)}, b = a;
    for (size_t i = 0; i < 20; ++i) a.pixels[i].y = float((i * 7) % 20 / 2);  // every value twice
    const ImageComparison result = compareImages(a, b);
    ASSERT_EQ(result.worst.size(), 10u);
    for (size_t rank = 0; rank < 10; ++rank) EXPECT_EQ(result.worst[rank].a.y, float(9 - rank / 2)) << rank;
    for (size_t rank = 0; rank < 10; rank += 2) {
        const WorstPixel &first = result.worst[rank], &second = result.worst[rank + 1];
        EXPECT_LT(first.y * 5 + first.x, second.y * 5 + second.x) << "ties are in row-major order";
    }
}

TEST(CompareImages, RefusesDifferentSizes) {
    expectError(ErrorCode::Usage, "2x1 and 1x2", [] {
        compareImages(Image{2, 1, std::vector<Vec3f>(2)}, Image{1, 2, std::vector<Vec3f>(2)});
    });
}
