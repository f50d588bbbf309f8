#include "farm/jobs/strangeness.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace antipode {
namespace {

constexpr double mostRatio = 4;

/// The image's sums, of all residue classes.
std::span<const int64_t> imageOf(const FilmSums& sums) {
    const size_t count = std::min<size_t>(sums.values.size(), 3 * sums.layout.pixels() * sums.layout.residueClasses());
    return std::span(sums.values).first(count);
}

double total(const FilmSums& sums) {
    const std::span<const int64_t> image = imageOf(sums);
    return std::accumulate(image.begin(), image.end(), 0.0);
}

}  // namespace

bool isBlack(const FilmSums& sums) {
    return std::ranges::all_of(imageOf(sums), [](int64_t sum) { return sum == 0; });
}

std::string strangeness(const FilmSums& block, const FilmSums& all) {
    // A device counts what it adds below 0.
    if (block.events.total(EventKind::Negative) == 0 &&
        std::ranges::any_of(imageOf(block), [](int64_t sum) { return sum < 0; }))
        return "is below 0";
    if (all.iterations <= block.iterations) return "";
    const double blockTotal = total(block);
    const double mean = blockTotal / double(block.iterations);
    const double rest = (total(all) - blockTotal) / double(all.iterations - block.iterations);
    if (mean > mostRatio * rest) return "is more than four times as bright as the rest";
    if (mean * mostRatio < rest) return "is less than a quarter as bright as the rest";
    return "";
}

}  // namespace antipode
