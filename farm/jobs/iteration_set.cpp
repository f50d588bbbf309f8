#include "farm/jobs/iteration_set.h"

#include <algorithm>
#include <iterator>

namespace antipode {

IterationSet::IterationSet(const std::vector<IterationRange>& ranges) {
    for (const IterationRange& range : ranges) add(range);
}

void IterationSet::add(const IterationRange& range) {
    if (range.count == 0) return;
    uint64_t first = range.first, end = range.end();
    // The first range that the new one overlaps or touches, then all that follow.
    auto it = ends_.upper_bound(first);
    if (it != ends_.begin() && std::prev(it)->second >= first) --it;
    while (it != ends_.end() && it->first <= end) {
        first = std::min(first, it->first);
        end = std::max(end, it->second);
        count_ -= it->second - it->first;
        it = ends_.erase(it);
    }
    ends_.emplace_hint(it, first, end);
    count_ += end - first;
}

void IterationSet::remove(const IterationRange& range) {
    if (range.count == 0) return;
    auto it = ends_.upper_bound(range.first);
    if (it != ends_.begin() && std::prev(it)->second > range.first) --it;
    while (it != ends_.end() && it->first < range.end()) {
        const auto [first, end] = *it;
        it = ends_.erase(it);
        count_ -= end - first;
        if (first < range.first) {
            ends_.emplace(first, range.first);
            count_ += range.first - first;
        }
        if (range.end() < end) {
            ends_.emplace(range.end(), end);
            count_ += end - range.end();
        }
    }
}

bool IterationSet::contains(const IterationRange& range) const {
    if (range.count == 0) return true;
    const auto after = ends_.upper_bound(range.first);
    return after != ends_.begin() && std::prev(after)->second >= range.end();
}

bool IterationSet::intersects(const IterationRange& range) const {
    if (range.count == 0) return false;
    const auto after = ends_.lower_bound(range.end());
    return after != ends_.begin() && std::prev(after)->second > range.first;
}

uint64_t IterationSet::count() const { return count_; }

uint64_t IterationSet::end() const { return ends_.empty() ? 0 : ends_.rbegin()->second; }

uint64_t IterationSet::prefix() const { return ends_.empty() || ends_.begin()->first != 0 ? 0 : ends_.begin()->second; }

std::vector<IterationRange> IterationSet::ranges() const {
    std::vector<IterationRange> result;
    result.reserve(ends_.size());
    for (const auto& [first, end] : ends_) result.push_back({first, end - first});
    return result;
}

std::vector<IterationRange> IterationSet::gaps(uint64_t end) const { return missing({0, end}); }

std::vector<IterationRange> IterationSet::missing(const IterationRange& range) const {
    std::vector<IterationRange> result;
    uint64_t next = range.first;
    auto it = ends_.upper_bound(range.first);
    if (it != ends_.begin()) --it;
    for (; it != ends_.end() && it->first < range.end(); ++it) {
        if (it->first > next) result.push_back({next, it->first - next});
        next = std::max(next, it->second);
    }
    if (next < range.end()) result.push_back({next, range.end() - next});
    return result;
}

}  // namespace antipode
