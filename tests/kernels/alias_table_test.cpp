// numerics/alias_table.h: the table must give back the probabilities that it was built from. Fixed seeds.
#include "numerics/alias_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/hard_case.h"
#include "support/random.h"
#include "support/worst.h"

namespace antipode {
namespace {

/// Probability of drawing every index, by adding up what each entry gives.
std::vector<double> drawnProbabilities(const std::vector<AliasEntry>& table) {
    std::vector<double> p(table.size());
    for (size_t i = 0; i < table.size(); ++i) {
        p[i] += double(table[i].threshold) / double(table.size());
        p.at(table[i].alias) += (1 - double(table[i].threshold)) / double(table.size());
    }
    return p;
}

void expectReconstructed(const std::vector<double>& weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto table = buildAliasTable(weights);
    ASSERT_EQ(table.size(), weights.size());
    // Thresholds are floats: every entry that has i as its alias may give it 2⁻²⁵ of a slot too much or too little.
    const auto p = drawnProbabilities(table);
    std::vector<double> roundings(weights.size(), 2);
    for (const AliasEntry& entry : table) ++roundings[entry.alias];
    Worst error;
    uint32_t impossible = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        const double expected = weights[i] / sum;
        error.add(std::abs(p[i] - expected) / (0x1p-25 * roundings[i] / double(weights.size())), std::to_string(i));
        impossible += weights[i] == 0 && p[i] != 0;
        EXPECT_GE(table[i].threshold, 0.0f);
        EXPECT_LE(table[i].threshold, 1.0f);
    }
    SCOPED_TRACE(error.where);
    const std::string difficulty = "emitters whose powers differ by up to 30 decades, some of power 0";
    expectWithin({"Lights", difficulty, "largest error of a probability, in roundings", 1}, error.value);
    expectWithin({"Lights", difficulty, "emitters of power 0 that can be picked", 0}, impossible);
}

TEST(AliasTable, SmallTables) {
    expectReconstructed({1});
    expectReconstructed({1, 1});
    expectReconstructed({1, 2, 3});
    expectReconstructed({0, 1});
    expectReconstructed({1, 0, 0, 0, 0});
    expectReconstructed({1e-30, 1, 1e-30});
    expectReconstructed({1e30, 1});
    expectReconstructed(std::vector<double>(7, 0.1));
}

TEST(AliasTable, LargeTables) {
    Random random(1);
    for (const double spread : {0.0, 1.0, 20.0}) {
        std::vector<double> weights(10000);
        for (double& w : weights) w = random.uniform() < 0.1 ? 0 : std::pow(10.0, random.uniform(-spread, 0));
        expectReconstructed(weights);
    }
}

}  // namespace
}  // namespace antipode
