// Alias tables: drawing from a discrete distribution in constant time (Walker 1977, built after Vose 1991).
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace antipode {

struct AliasEntry {
    float threshold;  ///< keep the entry when the fraction is below, else take the alias; in [0,1]
    uint32_t alias;
};

/// Entries for weights ≥ 0 of positive sum; drawing entry ⌊u·n⌋ and comparing frac(u·n) gives index i with
/// probability weights[i]/Σ.
inline std::vector<AliasEntry> buildAliasTable(const std::vector<double>& weights) {
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / double(weights.size());
    std::vector<double> scaled(weights.size());
    std::vector<uint32_t> below, above;
    std::vector<AliasEntry> table(weights.size());
    for (uint32_t i = 0; i < weights.size(); ++i) {
        scaled[i] = weights[i] / mean;
        (scaled[i] < 1.0 ? below : above).push_back(i);
        table[i] = {1.0f, i};
    }
    while (!below.empty() && !above.empty()) {
        const uint32_t small = below.back(), large = above.back();
        below.pop_back();
        table[small] = {float(scaled[small]), large};
        scaled[large] -= 1.0 - scaled[small];
        if (scaled[large] < 1.0) {
            above.pop_back();
            below.push_back(large);
        }
    }
    // What remains is 1 up to rounding. An entry of weight 0 must never be drawn, so that rounding may not keep one.
    for (uint32_t i : below)
        if (weights[i] == 0.0 && !above.empty()) table[i] = {0.0f, above.back()};
    return table;
}

}  // namespace antipode
