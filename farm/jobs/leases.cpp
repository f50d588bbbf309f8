#include "farm/jobs/leases.h"

#include <algorithm>
#include <cmath>

namespace antipode {
namespace {

/// Of a node that comes and goes; older ones are not worth remembering.
constexpr size_t mostLostLeases = 64;
/// Whatever a node says that it takes: an unlimited job could fill any number.
constexpr uint32_t mostLeasesPerNode = 16;

bool overlap(const IterationRange& a, const IterationRange& b) { return a.first < b.end() && b.first < a.end(); }

}  // namespace

Leases::Leases(const CoordinatorOptions& options, const IterationSet& committed, Messages& messages, uint64_t end)
    : options_(options), committed_(committed), messages_(messages), end_(end) {
    giveBack({0, end});
}

NodeId Leases::join(const NodeDescription& description, NodePort& port) {
    auto it = std::find_if(nodes_.begin(), nodes_.end(),
                           [&](const auto& known) { return known.second.description.name == description.name; });
    if (it == nodes_.end()) {
        NodeEntry node;
        node.speed = NodeSpeed(4 * options_.targetSeconds);
        it = nodes_.emplace(NodeId(nodes_.size() + 1), std::move(node)).first;
    } else {
        if (it->second.port) leave(it->first);
        const NodeDescription& before = it->second.description;
        // Another device under the old name: what is known of the old one says nothing about it.
        if (before.deviceName != description.deviceName || before.deviceClass != description.deviceClass) {
            it->second.speed = NodeSpeed(4 * options_.targetSeconds);
            it->second.largestBlock = 0;
            std::erase_if(leases_, [&](const auto& lease) { return lease.second.node == it->first; });
        }
    }
    it->second.description = description;
    it->second.description.leaseDepth = std::min(description.leaseDepth, mostLeasesPerNode);
    it->second.port = &port;
    it->second.retired = false;
    return it->first;
}

void Leases::leave(NodeId id) {
    NodeEntry& node = nodes_.at(id);
    node.port = nullptr;
    node.retired = node.stalled = false;
    node.queue.clear();
    node.active = 0;
    std::vector<LeaseId> lost;
    for (auto it = leases_.begin(); it != leases_.end();) {
        LeaseEntry& entry = it->second;
        if (entry.node != id) {
            ++it;
            continue;
        }
        if (!entry.check) lose(entry);
        entry.held = entry.offered = false;
        entry.expired = true;
        release(entry);
        const bool worthless = entry.check || node.quarantined || committed_.contains(entry.lease.range);
        if (!worthless) lost.push_back(entry.lease.id);
        it = worthless ? leases_.erase(it) : std::next(it);
    }
    if (lost.size() > mostLostLeases)
        for (size_t i = 0; i < lost.size() - mostLostLeases; ++i) leases_.erase(lost[i]);
}

void Leases::quarantine(NodeId id) {
    NodeEntry& node = nodes_.at(id);
    node.quarantined = true;
    std::vector<LeaseId> worthless;
    for (auto& [leaseId, entry] : leases_) {
        if (entry.node != id) continue;
        release(entry);
        if (entry.held)
            truncate(entry);
        else
            worthless.push_back(leaseId);
    }
    for (const LeaseId lease : worthless) leases_.erase(lease);
}

void Leases::grant(NodeId id, IterationRange range, bool check, double now) {
    NodeEntry& node = nodes_.at(id);
    LeaseEntry entry;
    entry.lease = {nextLease_++, range};
    entry.node = id;
    entry.check = check;
    entry.claims = !check;
    entry.granted = entry.clock = now;
    if (!check) pool_.remove(range);
    leases_.emplace(entry.lease.id, entry);
    node.queue.push_back(entry.lease.id);
    advance(node, now);
    node.port->grant(entry.lease);
}

LeaseEntry* Leases::find(NodeId node, LeaseId lease) {
    const auto found = leases_.find(lease);
    return found != leases_.end() && found->second.node == node ? &found->second : nullptr;
}

void Leases::advance(NodeEntry& node, double now) {
    const auto next = std::find_if(node.queue.begin(), node.queue.end(),
                                   [&](LeaseId lease) { return !leases_.at(lease).rendered(); });
    const LeaseId active = next == node.queue.end() ? 0 : *next;
    if (active != node.active && active != 0) leases_.at(active).clock = now;
    node.active = active;
}

/// The time of a lease that expired is left out: the node was not slow, it stood still.
void Leases::observe(LeaseEntry& entry, uint64_t done, double now) {
    NodeEntry& node = nodes_.at(entry.node);
    if (done <= entry.done) return;
    if (!entry.expired && (node.wide() || entry.lease.id == node.active))
        node.speed.observe(done - entry.done,
                           now - (node.wide() ? std::max(entry.granted, node.observedAt) : entry.clock));
    node.observedAt = now;
    node.largestBlock = std::max(node.largestBlock, done);
    entry.done = done;
}

void Leases::progress(LeaseEntry& entry, uint64_t done, double now) {
    if (done > entry.lease.range.count || (done <= entry.done && !entry.offered)) return;
    if (entry.offered) {
        nodes_.at(entry.node).transferAt = now;
    } else {
        observe(entry, done, now);
        if (entry.rendered()) entry.renderedAt = now;
    }
    entry.clock = now;
    if (entry.expired && (entry.held || entry.offered)) {
        entry.expired = false;
        reclaim(entry);
    }
    wake(entry.node);
    advance(nodes_.at(entry.node), now);
}

void Leases::offered(LeaseEntry& entry, uint64_t done, double now) {
    observe(entry, done, now);
    if (!entry.rendered()) entry.renderedAt = now;
    entry.offered = true;
    entry.expired = false;
    entry.clock = now;
    reclaim(entry);
    wake(entry.node);
    advance(nodes_.at(entry.node), now);
}

/// Before anybody else has taken its block over.
void Leases::reclaim(LeaseEntry& entry) {
    if (entry.check || entry.claims || entry.truncated || !pool_.contains(entry.lease.range)) return;
    pool_.remove(entry.lease.range);
    entry.claims = true;
}

void Leases::lose(LeaseEntry& entry) {
    if (entry.lost) return;
    entry.lost = true;
    nodes_.at(entry.node).lost += entry.lease.range.count;
}

void Leases::settle(LeaseEntry& entry, uint64_t committed, double now) {
    NodeEntry& node = nodes_.at(entry.node);
    if (entry.lost)
        node.lost -= committed;
    else if (committed == 0 && !entry.check && entry.done != 0)
        lose(entry);
    node.committed += committed;
    if (committed > 0) ++node.results;
    release(entry);
    std::erase(node.queue, entry.lease.id);
    leases_.erase(entry.lease.id);
    advance(node, now);
}

void Leases::truncate(LeaseEntry& entry) {
    if (entry.truncated || !entry.held) return;
    entry.truncated = true;
    nodes_.at(entry.node).port->truncate(entry.lease.id);
}

void Leases::wake(NodeId id) {
    NodeEntry& node = nodes_.at(id);
    if (!node.stalled) return;
    node.stalled = false;
    if (!node.quarantined) messages_.say("Node " + node.description.name + " makes progress again.");
}

double Leases::patience(const LeaseEntry& entry) const {
    const NodeSpeed& speed = nodes_.at(entry.node).speed;
    const double width = std::max(nodes_.at(entry.node).description.width, 1u);  // of so many, one takes as long
    const double iteration =
        speed.known() ? std::max(options_.leastPatienceSeconds, options_.patience * width * speed.secondsPerIteration())
                      : options_.firstPatienceSeconds;
    // A network is not measured, and sums of large images take their time.
    return entry.rendered() ? std::max(iteration, options_.firstPatienceSeconds) : iteration;
}

void Leases::expire(LeaseEntry& entry) {
    entry.expired = true;
    release(entry);
    if (!entry.check) lose(entry);
}

void Leases::expire(double now) {
    for (auto& [id, entry] : leases_) {
        NodeEntry& node = nodes_.at(entry.node);
        if (entry.expired || !node.port || (!entry.rendered() && node.active != id)) continue;
        const double sign = std::max({entry.clock, node.transferAt, node.wide() ? node.observedAt : 0});
        if (now - sign <= patience(entry)) continue;
        expire(entry);
        if (!node.stalled && !node.quarantined)
            messages_.say("Node " + node.description.name + " makes no progress; its work goes to others.");
        node.stalled = true;
        // What waits behind it would wait as long.
        for (const LeaseId queued : node.queue) {
            LeaseEntry& other = leases_.at(queued);
            if (!other.expired && !other.rendered()) expire(other);
        }
    }
}

void Leases::release(LeaseEntry& entry) {
    if (!entry.claims) return;
    entry.claims = false;
    giveBack(entry.lease.range);
}

void Leases::giveBack(const IterationRange& range) {
    if (range.first >= end_) return;
    const IterationRange needed{range.first, std::min(range.count, end_ - range.first)};
    for (const IterationRange& missing : committed_.missing(needed)) pool_.add(missing);
    for (const auto& [id, entry] : leases_)
        if (entry.claims && overlap(entry.lease.range, needed)) pool_.remove(entry.lease.range);
}

void Leases::committed(const LeaseEntry& by, const BlockResult& result) {
    pool_.remove(result.range);
    std::vector<LeaseId> worthless;
    for (auto& [id, entry] : leases_) {
        if (id == by.lease.id || entry.check || !overlap(entry.lease.range, result.range)) continue;
        release(entry);
        if (entry.lease.range == result.range)
            entry.winner = {by.node, nodes_.at(by.node).description.deviceClass, result.sha256};
        if (entry.held)
            truncate(entry);
        else if (committed_.contains(entry.lease.range))
            worthless.push_back(id);
    }
    for (const LeaseId lease : worthless) leases_.erase(lease);
}

void Leases::dropped(const IterationRange& range) {
    pool_.remove(range);
    for (auto& [id, entry] : leases_) {
        if (!overlap(entry.lease.range, range)) continue;
        release(entry);
        truncate(entry);
    }
}

uint64_t Leases::firstNotBegun(const IterationRange& range) const {
    IterationSet begun = committed_;
    for (const auto& [id, entry] : leases_)
        if (entry.claims && (entry.done > 0 || nodes_.at(entry.node).active == id)) begun.add(entry.lease.range);
    const std::vector<IterationRange> rest = begun.missing(range);
    return rest.empty() ? range.end() : rest.front().first;
}

uint64_t Leases::inHand(const IterationRange& range) const {
    uint64_t done = 0;
    for (const auto& [id, entry] : leases_)
        if (entry.claims && overlap(entry.lease.range, range)) done += entry.done;
    return done;
}

void Leases::uncommitted(const IterationSet& iterations) {
    for (const IterationRange& range : iterations.ranges()) giveBack(range);
    for (auto& [id, entry] : leases_)
        if (iterations.intersects(entry.lease.range)) entry.winner.reset();
}

void Leases::truncateAll() {
    for (auto& [id, entry] : leases_) truncate(entry);
}

void Leases::setEnd(uint64_t end) {
    if (end >= end_) return;
    end_ = end;
    for (auto& [id, entry] : leases_) {
        if (entry.lease.range.end() <= end) continue;
        release(entry);
        truncate(entry);
    }
}

std::optional<double> Leases::remaining(const LeaseEntry& entry, double now) const {
    const NodeEntry& node = nodes_.at(entry.node);
    if (!node.speed.known()) return {};
    if (entry.rendered()) return 0;
    const double perIteration = node.speed.secondsPerIteration();
    uint64_t iterations = 0;
    double overdue = 0;
    for (const LeaseId id : node.queue) {
        const LeaseEntry& queued = leases_.at(id);
        if (queued.rendered()) continue;
        iterations += queued.lease.range.count - queued.done;
        if (id == node.active) overdue = now - queued.clock;
        if (id == entry.lease.id) break;
    }
    // The iteration in hand: what is left of it, or as long again as it is late by now.
    return perIteration * (double(iterations) - 1) + std::abs(perIteration - overdue);
}

std::optional<double> Leases::predicted(const NodeEntry& node, uint64_t count, double now) const {
    if (!node.speed.known()) return {};
    double ahead = 0;
    if (!node.queue.empty()) ahead = *remaining(leases_.at(node.queue.back()), now);
    return ahead + node.speed.secondsPerIteration() * double(count);
}

}  // namespace antipode
