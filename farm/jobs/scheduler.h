// Which node gets which work.
#pragma once

#include <string>
#include <vector>

#include "farm/jobs/cross_check.h"
#include "farm/jobs/leases.h"
#include "farm/jobs/ledger.h"

namespace antipode {

/// The iterations that a node's next block should have: as many as it renders in the target time; at most twice as many
/// as it has ever rendered in one block, so that a first measurement in a cold start does no harm and the blocks of a
/// starting farm leave no gaps; and at most half of its share of what is left (guided self-scheduling, Polychronopoulos
/// & Kuck 1987), so that all nodes end together; but one for each that it renders side by side.
uint64_t blockSize(const NodeEntry& node, double totalRate, uint64_t remaining, double targetSeconds);

class Scheduler {
public:
    /// Blocks lie within what `ledger` sums up together.
    Scheduler(const CoordinatorOptions& options, Leases& leases, const Ledger& ledger, const CrossCheck& checks)
        : options_(options), leases_(leases), ledger_(ledger), checks_(checks) {}

    /// Fills the places of all nodes, a lease to each in turn, the fastest first: near the end the last blocks then go
    /// to those who are done with them soonest. `limit`: only iterations below it are begun.
    void handOut(uint64_t limit, double now);
    /// Whether a node that is there could render this check, now or later.
    bool canBeChecked(const CrossCheck::Check& check) const;

private:
    bool handOutOne(NodeId node, uint64_t limit, double totalRate, double targetSeconds, double now);
    bool handOutCheck(NodeId node, double now);
    bool handOutDuplicate(NodeId node, uint64_t limit, double now);
    bool eligible(const CrossCheck::Check& check, NodeId id, const NodeEntry& node) const;
    /// Whether the check would wait for the node much longer than for another one.
    bool tooSlowFor(const CrossCheck::Check& check, const NodeEntry& node) const;
    bool inHand(const CrossCheck::Check& check) const;
    /// Whether the node can be expected to be done with the block before its holder.
    bool wouldWin(const LeaseEntry& entry, const NodeEntry& node, double now) const;
    bool worthDuplicating(const LeaseEntry& entry, NodeId id, double now) const;

    const CoordinatorOptions options_;
    Leases& leases_;
    const Ledger& ledger_;
    const CrossCheck& checks_;
};

}  // namespace antipode
