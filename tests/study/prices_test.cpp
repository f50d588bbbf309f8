#include "client/study/prices.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/study/study_fixture.h"

using namespace antipode::study;

TEST(Prices, TellTimeAndErrorAgainstTheBase) {
    const std::vector<Price> list = prices(test::sceneOfThree());
    ASSERT_EQ(list.size(), 2u);
    const Price &pt = list[0], &inDouble = list[1];
    EXPECT_EQ(pt.variant, "pt");
    EXPECT_NEAR(pt.time.value, 1, 1e-9);
    EXPECT_NEAR(pt.error.value, 3, 1e-9);
    EXPECT_NEAR(pt.sameError.value, 9, 1e-6);
    EXPECT_EQ(inDouble.iterations, 64u);
    EXPECT_NEAR(inDouble.time.value, 1.9, 1e-9);
    EXPECT_LT(inDouble.time.low, 1.9);
    EXPECT_GT(inDouble.time.high, 1.9);
    EXPECT_NEAR(inDouble.error.value, 1, 1e-9);
    EXPECT_EQ(
        sentence(inDouble).find("Double precision: 1.9 × the time of vcm (1.89 to 1.91) and 1 × its error (1 to 1)"),
        0u)
        << sentence(inDouble);
    EXPECT_NE(sentence(inDouble).find("the same error costs 1.9 times as long."), std::string::npos);
    EXPECT_NE(sentence(pt).find("and 3 × its error (3 to 3) after 64 iterations; the same error costs 9 times"),
              std::string::npos)
        << sentence(pt);
}

TEST(Prices, SayWhatCannotBeTold) {
    Price price{"a", "A", "b", 1, {1, 0.9, 1.1}, {1, 0.9, 1.1}, {1, 0.8, 1.25}};
    EXPECT_NE(sentence(price).find("after 1 iteration; no difference at equal error that this study can tell."),
              std::string::npos);
    price.error = {NAN, NAN, NAN}, price.sameError = price.error;
    EXPECT_EQ(sentence(price),
              "A: 1 × the time of b (0.9 to 1.1) and an unknown share of its error after 1 iteration.");
}

TEST(Prices, PointsThatTellOfTheReferenceAreLeftOut) {
    VariantResult result = test::sceneOfThree().variants[0];
    Snapshot& last = result.snapshots.back();
    last.errors.referenceRelMse = 0.3 * last.errors.total();  // .3/1.3 = 23 %
    EXPECT_FALSE(limitedByReference(last, std::nullopt));
    last.errors.referenceRelMse = 0.4 * last.errors.total();  // .4/1.4 = 29 %
    EXPECT_TRUE(limitedByReference(last, std::nullopt));
    EXPECT_EQ(pointsOf(result, std::nullopt, &Snapshot::wall).size(), result.snapshots.size() - 1);
    EXPECT_DOUBLE_EQ(pointsOf(result, std::nullopt, &Snapshot::cpu)[0].seconds, 0.19);
}

// An outlier in the reference excuses itself where it is divided by; its classes do not.
TEST(Prices, AReferenceThatIsNotGoodEnoughGivesNoErrorRatio) {
    SceneResult scene = test::sceneOfThree();
    const Snapshot& last = scene.variants[0].snapshots.back();  // 2.5 %
    EXPECT_FALSE(limitedByReference(last, Interval{1.2, 1, 1.4}));
    EXPECT_TRUE(limitedByReference(last, Interval{1.3, 1, 1.4}));
    scene.referencePercent = Interval{300, 290, 310};
    EXPECT_TRUE(std::isnan(prices(scene)[1].error.value));
    EXPECT_NEAR(prices(scene)[1].time.value, 1.9, 1e-9);
    EXPECT_TRUE(pointsOf(scene.variants[0], scene.referencePercent, &Snapshot::wall).empty());
}
