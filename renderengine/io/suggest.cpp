#include "renderengine/io/suggest.h"

#include <algorithm>

namespace antipode {
namespace {

/// Optimal string alignment distance.
size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> distance(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) distance[i][0] = i;
    for (size_t j = 0; j <= b.size(); ++j) distance[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i)
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t substitution = distance[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            distance[i][j] = std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, substitution});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
        }
    return distance[a.size()][b.size()];
}

}  // namespace

std::string nearestName(std::string_view typed, const std::vector<std::string>& candidates) {
    constexpr size_t longestTyped = 64;  // bounds the table; nothing that long resembles a name of ours
    if (typed.size() > longestTyped) return "";
    const std::string* nearest = nullptr;
    size_t nearestDistance = 0;
    for (const std::string& candidate : candidates) {
        const size_t distance = editDistance(typed, candidate);
        // At most a third of the letters may be wrong, but one always.
        if (distance > std::max<size_t>(1, candidate.size() / 3)) continue;
        if (nearest && distance >= nearestDistance) continue;
        nearest = &candidate;
        nearestDistance = distance;
    }
    return nearest ? *nearest : "";
}

std::string suggestion(std::string_view typed, const std::vector<std::string>& candidates) {
    const std::string nearest = nearestName(typed, candidates);
    return nearest.empty() ? "" : " Did you mean '" + nearest + "'?";
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace antipode
