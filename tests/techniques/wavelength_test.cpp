// The wavelengths of iterations: fair to all colours, whatever part of a job's iterations is looked at.
#include "techniques/wavelength.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace antipode {
namespace {

Wavelength nearest(double nanometres) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (wavelengthAt(middle).nanometres < nanometres ? low : high) = middle;
    }
    return wavelengthAt(low);
}

TEST(Wavelength, WhiteStaysWhite) {
    constexpr int count = 100000;
    Vec3d mean;
    for (int i = 0; i < count; ++i) {
        const Vec3d seen = wavelengthAt((i + 0.5) / count).response;
        ASSERT_GE(std::min({seen.x, seen.y, seen.z}), 0);
        ASSERT_NEAR(seen.x + seen.y + seen.z, 3, 1e-12);
        mean += seen / double(count);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 1, 1e-6);
}

TEST(Wavelength, GrowsWithItsNumberFromVioletToRed) {
    double before = wavelengthAt(0).nanometres;
    EXPECT_NEAR(before, 380, 1e-6);
    for (int i = 1; i < 1000; ++i) {
        const double now = wavelengthAt(i / 1000.0).nanometres;
        ASSERT_GT(now, before);
        before = now;
    }
    EXPECT_NEAR(wavelengthAt(1 - 0x1p-33).nanometres, 780, 1);
}

/// Of each colour's name the wavelength at which its channel sees the most.
TEST(Wavelength, HasTheColourOfItsName) {
    const Vec3d blue = nearest(450).response, green = nearest(540).response, red = nearest(620).response,
                yellow = nearest(575).response, cyan = nearest(490).response;
    EXPECT_GT(blue.z, 5 * std::max(blue.x, blue.y));
    EXPECT_GT(green.y, 5 * std::max(green.x, green.z));
    EXPECT_GT(red.x, 5 * std::max(red.y, red.z));
    EXPECT_GT(std::min(yellow.x, yellow.y), 20 * yellow.z);
    EXPECT_GT(std::min(cyan.y, cyan.z), 20 * cyan.x);
}

/// Cauchy's A + B/λ² through the catalogue's values of Schott's N-BK7 at F and C meets the one at d.
TEST(Wavelength, FollowsCauchyThroughTheLinesOfTheAbbeNumber) {
    constexpr double nF = 1.52238, nC = 1.51432;
    const double b = (nF - nC) / (1 / (486.1 * 486.1) - 1 / (656.3 * 656.3));
    for (const double nm : {400.0, 486.1, 550.0, 587.6, 656.3, 700.0}) {
        const double cauchy = nF + b * (1 / (nm * nm) - 1 / (486.1 * 486.1));
        const double nD = nF + b * (1 / (587.6 * 587.6) - 1 / (486.1 * 486.1));
        EXPECT_NEAR(nD + (nF - nC) * nearest(nm).dispersion, cauchy, 1e-7) << nm;
        EXPECT_NEAR(nD, 1.5168, 1e-4);
    }
}

/// Blocks as leases have them, and the classes of iterations that stand for independent images.
TEST(Wavelength, BlocksAndResidueClassesAreStratified) {
    for (const uint64_t seed : {1, 2, 77})
        for (const uint64_t stride : {1, 2, 4, 8, 16})
            for (const uint64_t count : {2, 8, 64})
                for (const uint64_t block : {0, 1, 5})
                    for (uint64_t residue = 0; residue < stride; ++residue) {
                        std::set<uint64_t> strata;
                        for (uint64_t i = 0; i < count; ++i) {
                            const uint64_t index = (block * count + i) * stride + residue;
                            strata.insert(uint64_t(wavelengthNumber(seed, index + 1) * double(count)));
                        }
                        ASSERT_EQ(strata.size(), count) << seed << " " << stride << " " << block << " " << residue;
                    }
}

/// χ² of 64 cells over 6,400 seeds for each of three iterations, α = .01 over the three (Šidák).
TEST(Wavelength, OfOneIterationIsUniformOverTheSeeds) {
    for (const uint64_t iteration : {1, 2, 1000}) {
        std::vector<double> found(64), expected(64, 100);
        for (uint64_t seed = 1; seed <= 6400; ++seed) ++found[size_t(wavelengthNumber(seed, iteration) * 64)];
        EXPECT_GT(chiSquareTest(found, expected).pValue, sidak(0.01, 3)) << iteration;
    }
}

}  // namespace
}  // namespace antipode
