#include "farm/jobs/block_pool.h"

#include <algorithm>
#include <bit>

namespace antipode {
namespace {

/// The largest dyadic block of at most `size` iterations that starts where the range does and lies within it.
IterationRange frontOf(const IterationRange& range, uint64_t size) {
    uint64_t count = std::min(size, std::bit_floor(range.count));
    if (range.first != 0) count = std::min(count, uint64_t(1) << std::countr_zero(range.first));
    return {range.first, count};
}

IterationRange below(const IterationRange& range, uint64_t end) {
    return {range.first, range.first < end ? std::min(range.count, end - range.first) : 0};
}

}  // namespace

uint64_t BlockPool::count(uint64_t end) const {
    if (free_.end() <= end) return free_.count();
    uint64_t count = 0;
    for (const IterationRange& range : free_.ranges()) count += below(range, end).count;
    return count;
}

std::optional<IterationRange> BlockPool::find(uint64_t size, uint64_t end) const {
    std::optional<IterationRange> front;
    for (const IterationRange& range : free_.ranges()) {
        const IterationRange part = below(range, end);
        if (part.count == 0) break;
        if (!front) {
            front = frontOf(part, size);
            if (2 * front->count >= size) return front;
        }
        const IterationRange aligned{(part.first + size - 1) / size * size, size};
        if (part.contains(aligned)) return aligned;
    }
    return front;
}

std::optional<IterationRange> BlockPool::take(uint64_t size, uint64_t end) {
    const std::optional<IterationRange> block = find(size, end);
    if (block) free_.remove(*block);
    return block;
}

}  // namespace antipode
