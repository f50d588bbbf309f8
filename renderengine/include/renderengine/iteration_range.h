// Global iterations as half-open ranges. The first iteration of a job has index 0 here and is `render(1)` for an
// engine.
#pragma once

#include <cstdint>

namespace antipode {

/// Iterations first, first+1, …, first+count−1.
struct IterationRange {
    uint64_t first = 0, count = 0;

    uint64_t end() const { return first + count; }
    bool contains(const IterationRange& other) const { return first <= other.first && other.end() <= end(); }
    bool operator==(const IterationRange&) const = default;
};

/// Whether the range is [k·2^L, (k+1)·2^L) for some k and L. Two dyadic ranges nest or are disjoint.
constexpr bool isDyadic(const IterationRange& range) {
    return range.count != 0 && (range.count & (range.count - 1)) == 0 && range.first % range.count == 0;
}

}  // namespace antipode
