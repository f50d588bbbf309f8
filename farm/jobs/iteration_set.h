// A set of iterations, kept as few ranges.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "renderengine/iteration_range.h"

namespace antipode {

class IterationSet {
public:
    IterationSet() = default;
    explicit IterationSet(const std::vector<IterationRange>& ranges);

    void add(const IterationRange& range);
    void remove(const IterationRange& range);

    bool contains(const IterationRange& range) const;    ///< all of it
    bool intersects(const IterationRange& range) const;  ///< any of it
    uint64_t count() const;
    bool empty() const { return ends_.empty(); }
    uint64_t end() const;                        ///< one past the last iteration; 0 where empty
    uint64_t prefix() const;                     ///< the largest n with [0, n) contained
    std::vector<IterationRange> ranges() const;  ///< disjoint, not adjacent, ascending
    /// What of [0, end) is not contained.
    std::vector<IterationRange> gaps(uint64_t end) const;
    /// What of `range` is not contained.
    std::vector<IterationRange> missing(const IterationRange& range) const;

    bool operator==(const IterationSet&) const = default;

private:
    std::map<uint64_t, uint64_t> ends_;  ///< first → end
    uint64_t count_ = 0;
};

}  // namespace antipode
