// The tabulated losses against quadrature of another kind.
#include "gpu/loss_tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/closed_forms.h"

namespace antipode {
namespace {

TEST(LossTables, WhiteFacetsLoseWhatTheClosedFormLacks) {
    for (double alpha : {0.02, 0.05, 0.1, 0.17, 0.3, 0.5, 0.77, 1.0})
        for (double cosine : {0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.8, 0.93, 1.0})
            EXPECT_NEAR(tabulatedMetalLoss(cosine, alpha), 1 - closed_forms::ggxSingleScatterAlbedo(alpha, cosine),
                        1e-3)
                << "α " << alpha << ", cosine " << cosine;
}

TEST(LossTables, GlassLosesWhatTheClosedFormLacks) {
    double squares = 0, count = 0;
    for (double n : {1.33, 1.5})
        for (double eta : {n, 1 / n})
            for (double alpha : {0.1, 0.25, 1.0})
                for (double cosine : {0.1, 0.55, 0.95}) {
                    const double error = tabulatedGlassLoss(cosine, alpha, eta) -
                                         (1 - closed_forms::ggxSingleScatterGlass(alpha, cosine, eta));
                    // Near the angle of total reflection losses bend within less than a cell.
                    EXPECT_NEAR(error, 0, 5e-3) << "index " << eta << ", α " << alpha << ", cosine " << cosine;
                    squares += error * error;
                    ++count;
                }
    EXPECT_LE(std::sqrt(squares / count), 1.5e-3);
}

/// What is tabulated as the mean is the mean of what is tabulated, so that multiple scattering gives back all of it.
TEST(LossTables, MeansAreThoseOfTheLosses) {
    const auto meanOf = [](auto loss) {
        constexpr int steps = 20000;
        double mean = 0;
        for (int i = 0; i < steps; ++i) {
            // Even in the root of the cosine, which narrow lobes need.
            const double at = (i + 0.5) / steps, cosine = at * at;
            mean += loss(cosine) * 2 * cosine * 2 * at / steps;
        }
        return mean;
    };
    for (double alpha : {1e-4, 2e-4, 0.003, 0.01, 0.05, 0.2, 0.6, 1.0}) {
        SCOPED_TRACE(testing::Message() << "α " << alpha);
        const double metal = meanOf([&](double cosine) { return tabulatedMetalLoss(cosine, alpha); });
        EXPECT_NEAR(tabulatedMetalMeanLoss(alpha) / metal, 1, 2e-3);
        for (double eta : {1.2, 1.5, 1 / 1.2, 1 / 1.5, 1 / 2.4}) {
            const double glass = meanOf([&](double cosine) { return tabulatedGlassLoss(cosine, alpha, eta); });
            EXPECT_NEAR(tabulatedGlassMeanLoss(alpha, eta) / glass, 1, 5e-3) << "index " << eta;
        }
    }
}

TEST(LossTables, ArePackedByTheCell) {
    const auto texels = packLosses(false);
    constexpr size_t row = shared::LOSS_COSINES - 1;
    ASSERT_EQ(texels.size(), row * (shared::LOSS_ROUGHNESSES - 1) + shared::LOSS_MEANS - 1);
    EXPECT_EQ(texels[0].y, texels[1].x);
    EXPECT_EQ(texels[0].z, texels[row].x);
    EXPECT_EQ(texels[0].w, texels[row].y);
    EXPECT_EQ(double(texels[row * (shared::LOSS_ROUGHNESSES - 1) - 1].w), tabulatedMetalLoss(1, 1));

    const auto both = packLosses(true);
    constexpr size_t table = row * (shared::GLASS_LOSS_ROUGHNESSES - 1);
    ASSERT_EQ(both.size(), texels.size() + shared::GLASS_LOSS_INDICES * (2 * table + shared::GLASS_LOSS_MEANS - 1));
    // Of index 1.5, the fourth of the nodes, from outside and from inside.
    EXPECT_EQ(double(both[texels.size() + 4 * table - 1].w), tabulatedGlassLoss(1, 1, 1.5));
    EXPECT_EQ(double(both[texels.size() + (shared::GLASS_LOSS_INDICES + 4) * table - 1].w),
              tabulatedGlassLoss(1, 1, 1 / 1.5));
}

}  // namespace
}  // namespace antipode
