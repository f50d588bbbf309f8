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

}  // namespace antipode
