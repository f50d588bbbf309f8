#include "farm/jobs/parts.h"

#include <algorithm>
#include <iterator>

namespace antipode {

Parts::Parts(bool withdrawable) : withdrawable_(withdrawable) { committed_.add({0, endOfTime}); }

void Parts::ask(const IterationRange& block) {
    parts_.emplace(block.first, Part{block, Merge(withdrawable_, false, {})});
    committed_.remove(block);
}

void Parts::cut(uint64_t first, uint64_t end) {
    IterationRange& range = parts_.at(first).range;
    if (end >= range.end()) return;
    committed_.add({end, range.end() - end});
    range.count = end - first;
}

std::optional<BlockResult> Parts::take(uint64_t first) {
    auto part = parts_.extract(first);
    const IterationRange range = part.mapped().range;
    Merge& merge = part.mapped().merge;
    committed_.add(range);
    if (range.count == 0) return {};
    BlockResult result;
    result.range = range;
    result.statistics = merge.statistics();
    result.sums = merge.release();
    return result;
}

std::optional<IterationRange> Parts::find(uint64_t first) const {
    const auto part = parts_.find(first);
    return part == parts_.end() ? std::nullopt : std::optional(part->second.range);
}

std::vector<uint64_t> Parts::whole() const {
    std::vector<uint64_t> all;
    for (const auto& [first, part] : parts_)
        if (part.range.count == 0 || committed_.contains(part.range)) all.push_back(first);
    return all;
}

uint64_t Parts::committedEnd(uint64_t first) const { return std::max(first, parts_.at(first).merge.committed().end()); }

uint64_t Parts::committedCount(uint64_t first) const { return parts_.at(first).merge.committed().count(); }

const Parts::Part* Parts::at(uint64_t iteration) const {
    auto next = parts_.upper_bound(iteration);
    if (next == parts_.begin()) return nullptr;
    const Part& part = std::prev(next)->second;
    return iteration < part.range.end() ? &part : nullptr;
}

bool Parts::takes(const IterationRange& range) const {
    const Part* part = at(range.first);
    return part && part->range.contains(range) && !committed_.intersects(range);
}

void Parts::add(uint32_t node, const std::string& deviceClass, const BlockResult& result) {
    parts_.at(at(result.range.first)->range.first).merge.add(node, deviceClass, result);
    committed_.add(result.range);
}

IterationSet Parts::withdraw(uint32_t node) {
    IterationSet withdrawn;
    for (auto& [first, part] : parts_)
        for (const IterationRange& range : part.merge.withdraw(node).ranges()) withdrawn.add(range);
    for (const IterationRange& range : withdrawn.ranges()) committed_.remove(range);
    return withdrawn;
}

const FilmSums& Parts::sums() const {
    for (const auto& [first, part] : parts_)
        if (!part.merge.sums().values.empty()) return part.merge.sums();
    return none_;
}

uint64_t Parts::endOfSums(uint64_t iteration) const {
    const Part* part = at(iteration);
    return part ? part->range.end() : endOfTime;
}

}  // namespace antipode
