#include "farm/jobs/scheduler.h"

#include <algorithm>
#include <bit>

#include "renderengine/error_classes.h"

namespace antipode {
namespace {

/// Whatever a clock says.
constexpr double largestBlock = 1 << 16;
constexpr double longestTargetSeconds = 60;

}  // namespace

uint64_t blockSize(const NodeEntry& node, double totalRate, uint64_t remaining, double targetSeconds) {
    const double rate = node.speed.rate();
    const double width = std::max(node.description.width, 1u);  // less would leave some of it idle
    if (!node.speed.known()) return std::bit_floor(uint64_t(width));
    const double size = std::min({targetSeconds * rate, 2.0 * double(node.largestBlock),
                                  double(remaining) * (rate / totalRate) / 2, largestBlock});
    return std::bit_floor(uint64_t(std::max(size, width)));
}

void Scheduler::handOut(uint64_t limit, double now) {
    double totalRate = 0, usable = 0;
    std::vector<NodeId> order;
    for (const auto& [id, node] : leases_.nodes()) {
        if (node.usable()) totalRate += node.speed.rate(), ++usable;
        if (node.hasRoom()) order.push_back(id);
    }
    const double mergeable = std::min(usable / options_.mostResultsPerSecond, longestTargetSeconds);
    const double targetSeconds = std::max(options_.targetSeconds, mergeable);
    const auto rateOf = [&](NodeId id) { return leases_.nodes().at(id).speed.rate(); };
    std::ranges::stable_sort(order, [&](NodeId a, NodeId b) { return rateOf(a) > rateOf(b); });
    while (!order.empty())
        std::erase_if(order, [&](NodeId id) {
            return !handOutOne(id, limit, totalRate, targetSeconds, now) || !leases_.nodes().at(id).hasRoom();
        });
}

bool Scheduler::handOutOne(NodeId id, uint64_t limit, double totalRate, double targetSeconds, double now) {
    if (handOutCheck(id, now)) return true;
    uint64_t size = blockSize(leases_.nodes().at(id), totalRate, leases_.pool().count(limit), targetSeconds);
    // Later runs are no shorter.
    if (options_.errorClasses) size = std::min(size, errorRun(leases_.pool().first()).count);
    if (const auto block = leases_.pool().take(size, std::min(limit, ledger_.endOfSums(leases_.pool().first())))) {
        leases_.grant(id, *block, false, now);
        return true;
    }
    return handOutDuplicate(id, limit, now);
}

bool Scheduler::eligible(const CrossCheck::Check& check, NodeId id, const NodeEntry& node) const {
    return node.usable() && node.description.deviceClass == check.deviceClass && !check.has(id);
}

bool Scheduler::canBeChecked(const CrossCheck::Check& check) const {
    return std::ranges::any_of(leases_.nodes(),
                               [&](const auto& node) { return eligible(check, node.first, node.second); });
}

bool Scheduler::tooSlowFor(const CrossCheck::Check& check, const NodeEntry& node) const {
    return std::ranges::any_of(leases_.nodes(), [&](const auto& other) {
        return eligible(check, other.first, other.second) && other.second.speed.rate() > 2 * node.speed.rate();
    });
}

bool Scheduler::inHand(const CrossCheck::Check& check) const {
    return std::ranges::any_of(leases_.all(), [&](const auto& lease) {
        const LeaseEntry& entry = lease.second;
        return entry.check && entry.lease.range == check.range && entry.held && !entry.expired && !entry.truncated;
    });
}

bool Scheduler::handOutCheck(NodeId id, double now) {
    for (const auto& [first, check] : checks_.pending()) {
        const NodeEntry& node = leases_.nodes().at(id);
        if (!eligible(check, id, node) || inHand(check) || tooSlowFor(check, node)) continue;
        leases_.grant(id, check.range, true, now);
        return true;
    }
    return false;
}

bool Scheduler::wouldWin(const LeaseEntry& entry, const NodeEntry& node, double now) const {
    const auto own = leases_.predicted(node, entry.lease.range.count, now);
    const auto holders = leases_.remaining(entry, now);
    if (own && holders && *own < *holders) return true;
    if (entry.rendered()) return now - entry.renderedAt > options_.leastPatienceSeconds;
    return !holders && now - entry.granted > options_.leastPatienceSeconds;
}

bool Scheduler::worthDuplicating(const LeaseEntry& entry, NodeId id, double now) const {
    if (!entry.claims || entry.truncated || !wouldWin(entry, leases_.nodes().at(id), now)) return false;
    return std::ranges::none_of(leases_.all(), [&](const auto& lease) {
        const LeaseEntry& other = lease.second;
        const bool isDuplicate = other.claims && other.lease.id != entry.lease.id;
        return !other.check && other.lease.range == entry.lease.range &&
               (isDuplicate || (other.held && other.node == id));
    });
}

bool Scheduler::handOutDuplicate(NodeId id, uint64_t limit, double now) {
    for (const auto& [leaseId, entry] : leases_.all()) {  // the oldest first
        if (entry.lease.range.end() > limit || !worthDuplicating(entry, id, now)) continue;
        leases_.grant(id, entry.lease.range, false, now);
        return true;
    }
    return false;
}

}  // namespace antipode
