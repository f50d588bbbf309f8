// The iterations that nobody renders and nobody has rendered, and how blocks are cut out of them.
#pragma once

#include <optional>

#include "farm/jobs/iteration_set.h"

namespace antipode {

/// Stands for "no end" where a job is unlimited; far from the overflow of sums of two iterations.
constexpr uint64_t endOfTime = uint64_t(1) << 62;

class BlockPool {
public:
    void add(const IterationRange& range) { free_.add(range); }
    void remove(const IterationRange& range) { free_.remove(range); }
    bool contains(const IterationRange& range) const { return free_.contains(range); }
    /// The lowest free iteration; nothing is free where it is endOfTime or more.
    uint64_t first() const { return free_.empty() ? endOfTime : free_.ranges().front().first; }
    /// Free iterations below `end`.
    uint64_t count(uint64_t end) const;
    /// Takes a dyadic block of at most `size` iterations, a power of two, below `end`: the lowest free place of that
    /// size; but a smaller block at the front where that is at least half as large, or where there is no such place.
    /// Takes time in proportion to the number of free ranges.
    std::optional<IterationRange> take(uint64_t size, uint64_t end);

private:
    std::optional<IterationRange> find(uint64_t size, uint64_t end) const;

    IterationSet free_;
};

}  // namespace antipode
