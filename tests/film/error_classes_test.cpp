// The classes that the client parts a job's iterations into.
#include "renderengine/error_classes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/film/expect_error.h"
#include "tests/support/dyadic.h"

using namespace antipode;

TEST(ErrorClasses, RunsTileAllIterationsAndAreDyadic) {
    for (uint64_t first = 0; first < 5000;) {
        const IterationRange run = errorRun(first);
        ASSERT_EQ(run.first, first);
        ASSERT_TRUE(test::isDyadic(run));
        for (uint64_t i = first; i < run.end(); ++i) {
            ASSERT_EQ(errorRun(i), run) << i;
            ASSERT_EQ(errorClass(i), errorClass(first)) << i;
        }
        first = run.end();
    }
    const uint64_t late = (uint64_t(1) << 61) + 12345;
    EXPECT_EQ(errorRun(late).count, uint64_t(1) << 59);
}

TEST(ErrorClasses, IterationsAreCountedByClass) {
    std::vector<uint64_t> counts(errorClasses, 0);
    for (uint64_t i = 0; i < 5000; ++i) ASSERT_EQ(errorClassIndex(i), counts[errorClass(i)]++) << i;
}

TEST(ErrorClasses, AnOctaveHasARunOfEach) {
    std::vector<uint64_t> counts(errorClasses, 0);
    for (uint64_t i = 0; i < 4096; ++i) {
        ++counts[errorClass(i)];
        if (i + 1 < errorClasses || (i & (i + 1)) != 0) continue;
        for (const uint64_t count : counts) EXPECT_EQ(count, (i + 1) / errorClasses);
    }
}

TEST(ErrorClasses, ClassesHaveLikeRadii) {
    // Σ r² of the first 4096 iterations, r² ∝ i^(−1/3): what classes differ by would count as noise.
    std::vector<double> squares(errorClasses, 0);
    for (uint64_t i = 0; i < 4096; ++i) squares[errorClass(i)] += std::pow(double(i + 1), -1.0 / 3);
    const auto [least, greatest] = std::ranges::minmax(squares);
    EXPECT_LT(greatest / least, 1.12);
}

TEST(ErrorClasses, AFilmInClassesHoldsTheSameImage) {
    FilmSums part{
        {2, 1, {{LayerKind::Image, "", "RGB", 20}, {LayerKind::Depth, "", "Z", 3}}}, 1, {1, 2, 3, 4, 5, 6, 70, 80}, {}};
    FilmSums total = inErrorClasses(part, 9);
    for (uint64_t i = 10; i < 16; ++i) total.merge(inErrorClasses(part, i));
    EXPECT_EQ(total.layout.residueClasses(), errorClasses);
    EXPECT_EQ(total.values.size(), total.layout.values());
    EXPECT_EQ(total.residueIterations, (std::vector<uint64_t>{1, 2, 2, 2}));
    EXPECT_EQ(total.imageAlone().values, (std::vector<int64_t>{7, 14, 21, 28, 35, 42}));
    EXPECT_EQ(total.layer(errorClasses).front(), 490);

    FilmSums direct = inErrorClasses(part, 9);
    for (uint64_t i = 10; i < 16; ++i) direct.merge(part, errorClass(i));
    EXPECT_EQ(direct.sha256(), total.sha256());
    const FilmSums back = outOfErrorClasses(total);
    EXPECT_EQ(back.layout, part.layout);
    EXPECT_EQ(back.values, (std::vector<int64_t>{7, 14, 21, 28, 35, 42, 490, 560}));
    EXPECT_TRUE(back.residueIterations.empty());
    EXPECT_TRUE(hasErrorClasses(total.layout));
    EXPECT_FALSE(hasErrorClasses(back.layout));
    EXPECT_EQ(total.layerImages().size(), 1u) << "classes without names are not written";
}

TEST(ErrorClasses, BlurComesInClassesBesideTheImage) {
    FilmSums part{{1,
                   1,
                   {{LayerKind::Image, "", "RGB", 20},
                    {LayerKind::Albedo, "albedo", "RGB", 32},
                    {LayerKind::Blur, "bias", "Y", 12}}},
                  1,
                  {1, 2, 3, 4, 5, 6, -7},
                  {}};
    FilmSums total = inErrorClasses(part, 9);
    for (uint64_t i = 10; i < 16; ++i) total.merge(part, errorClass(i));
    ASSERT_EQ(total.layout, withErrorClasses(part.layout));
    EXPECT_EQ(withoutErrorClasses(total.layout), part.layout);
    EXPECT_EQ(total.layout.channels(), errorClasses * 3 + 3 + errorClasses);
    const size_t blur = total.layout.find(LayerKind::Blur);
    std::vector<int64_t> sums;
    for (uint32_t k = 0; k < errorClasses; ++k) {
        sums.push_back(total.layer(blur + k)[0]);
        EXPECT_EQ(total.iterationsOf(blur + k), total.residueIterations[k]);
    }
    EXPECT_EQ(sums, (std::vector<int64_t>{-7, -14, -14, -14}));
    EXPECT_EQ(total.layer(errorClasses)[0], 28) << "of all iterations";
    EXPECT_EQ(total.iterationsOf(errorClasses), 7u);
    const FilmSums back = outOfErrorClasses(total);
    EXPECT_EQ(back.layout, part.layout);
    EXPECT_EQ(back.values, (std::vector<int64_t>{7, 14, 21, 28, 35, 42, -49}));
    EXPECT_EQ(total.layerImages().size(), 1u) << "it is told, not shown";
}

TEST(ErrorClasses, ASumOverClassesThatWouldOverflowChangesNothing) {
    FilmSums part{{1, 1, {{LayerKind::Image, "", "RGB", 20}}}, 1, {0, 0, int64_t(1) << 62}, {}};
    FilmSums total = inErrorClasses(part, 0);
    const FilmSums before = total;
    test::expectError(ErrorCode::Device, "would overflow", [&] { total.merge(part, 1); });
    EXPECT_EQ(total.sha256(), before.sha256());
    part.layout.width = 2;
    test::expectError(ErrorCode::Usage, "cannot be merged", [&] { total.merge(part, 1); });
}
