#include "farm/jobs/cross_check.h"

#include <algorithm>

namespace antipode {
namespace {

constexpr size_t mostPending = 1 << 16;

/// The finaliser of SplitMix64 (Steele, Lea & Flood 2014): every bit of the result depends on every bit of the value.
uint64_t mix(uint64_t value) {
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9u;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBu;
    return value ^ (value >> 31);
}

}  // namespace

bool CrossCheck::Check::has(uint32_t node) const {
    return std::ranges::any_of(votes, [node](const Vote& vote) { return vote.node == node; });
}

bool CrossCheck::drawn(uint64_t first) const {
    return double(mix(mix(seed_ + 0x9E3779B97F4A7C15u) + first) >> 11) * 0x1p-53 < fraction_;
}

bool CrossCheck::add(const IterationRange& range, const std::string& deviceClass, Vote vote) {
    if (pending_.size() >= mostPending && !pending_.contains(range.first)) return false;
    pending_[range.first] = {range, deviceClass, {std::move(vote)}};
    return true;
}

const CrossCheck::Check* CrossCheck::find(const IterationRange& range) const {
    const auto found = pending_.find(range.first);
    return found != pending_.end() && found->second.range == range ? &found->second : nullptr;
}

CrossCheck::Outcome CrossCheck::vote(const IterationRange& range, Vote vote) {
    Outcome outcome;
    Check& check = pending_.at(range.first);
    if (check.has(vote.node)) return outcome;
    const auto agrees = [&](const Vote& other) { return other.sha256 == vote.sha256; };
    outcome.differs = !std::ranges::all_of(check.votes, agrees);
    if (std::ranges::none_of(check.votes, agrees)) {
        check.votes.push_back(std::move(vote));
        return outcome;
    }
    for (const Vote& other : check.votes)
        if (!agrees(other)) outcome.wrong.push_back(other.node);
    pending_.erase(range.first);
    return outcome;
}

void CrossCheck::withdraw(uint32_t node) {
    for (auto it = pending_.begin(); it != pending_.end();) {
        std::vector<Vote>& votes = it->second.votes;
        if (votes.front().node == node) {
            it = pending_.erase(it);
            continue;
        }
        std::erase_if(votes, [node](const Vote& vote) { return vote.node == node; });
        ++it;
    }
}

}  // namespace antipode
