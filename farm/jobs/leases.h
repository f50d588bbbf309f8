// Who holds what: nodes, their leases, and when a lease expires.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "farm/jobs/block_pool.h"
#include "farm/jobs/coordinator_options.h"
#include "farm/jobs/iteration_set.h"
#include "farm/jobs/messages.h"
#include "farm/jobs/node_port.h"
#include "farm/jobs/node_speed.h"
#include "renderengine/block_worker.h"

namespace antipode {

/// A lease that its node has not settled. Its result is welcome in every state as long as its iterations are needed.
struct LeaseEntry {
    Lease lease;
    NodeId node = 0;
    bool check = false;      ///< renders a committed block once more
    bool claims = false;     ///< keeps its range out of the pool
    bool held = true;        ///< takes one of the node's places: it was granted in the node's current connection
    bool truncated = false;  ///< the node has been told to end it
    bool expired = false;    ///< the deadline has passed, without a sign of life since
    bool offered = false;    ///< the result is being transferred
    bool lost = false;       ///< counted in the node's lost iterations
    uint64_t done = 0;       ///< iterations that are known to be rendered
    double granted = 0;
    double clock = 0;       ///< since when the node could have been making its next iteration
    double renderedAt = 0;  ///< where rendered()

    /// Who was faster with the very same block, for a comparison of the hashes.
    struct Winner {
        NodeId node;
        std::string deviceClass, sha256;
    };
    std::optional<Winner> winner;

    bool rendered() const { return offered || done == lease.range.count; }
};

struct NodeEntry {
    NodeDescription description;
    NodePort* port = nullptr;  ///< nothing while it is gone
    bool retired = false, stalled = false, quarantined = false;
    NodeSpeed speed{16};
    uint64_t largestBlock = 0;   ///< of those that it has rendered
    std::vector<LeaseId> queue;  ///< the leases that it holds, in the order in which it renders them
    LeaseId active = 0;          ///< the first of them that is not rendered, or 0
    double transferAt = 0;       ///< when a part of a result came last: what is said of other leases waits behind it
    double observedAt = 0;       ///< when it was known last to have made an iteration, of any lease
    uint64_t committed = 0, results = 0, lost = 0;
    uint32_t refusals = 0;   ///< results in a row that could not be taken
    std::string quarantine;  ///< why, where quarantined

    bool usable() const { return port && description.width > 0 && !retired && !stalled && !quarantined; }
    /// It renders the iterations of several leases side by side: what they take is known of all of them together.
    bool wide() const { return description.width > 1; }
    bool hasRoom() const { return usable() && queue.size() < description.leaseDepth; }
};

/// Keeps one invariant: every iteration below end() is committed, claimed by a lease, or in the pool.
class Leases {
public:
    /// `committed` is kept up to date by its owner, who tells of changes by committed() and uncommitted().
    Leases(const CoordinatorOptions& options, const IterationSet& committed, Messages& messages, uint64_t end);

    // ---- Nodes

    NodeId join(const NodeDescription& description, NodePort& port);
    void retire(NodeId node) { nodes_.at(node).retired = true; }
    void leave(NodeId node);
    /// Nothing it holds counts any more, and it gets nothing again.
    void quarantine(NodeId node);
    std::map<NodeId, NodeEntry>& nodes() { return nodes_; }
    const std::map<NodeId, NodeEntry>& nodes() const { return nodes_; }

    // ---- The life of a lease

    void grant(NodeId node, IterationRange range, bool check, double now);
    /// Nothing where the node was never granted such a lease or has settled it. Valid until it is settled.
    LeaseEntry* find(NodeId node, LeaseId lease);
    /// `done` iterations are rendered, or more of the result has come. Anything that says nothing new is ignored.
    void progress(LeaseEntry& entry, uint64_t done, double now);
    /// The result is about to be transferred.
    void offered(LeaseEntry& entry, uint64_t done, double now);
    /// Ends the lease, of which so many iterations were committed. What it claims beyond goes back to the pool.
    void settle(LeaseEntry& entry, uint64_t committed, double now);
    void truncate(LeaseEntry& entry);
    void truncateAll();
    /// Expires leases whose nodes show no progress, which stalls the nodes.
    void expire(double now);
    /// The node has answered or made progress.
    void wake(NodeId node);

    std::map<LeaseId, LeaseEntry>& all() { return leases_; }
    const std::map<LeaseId, LeaseEntry>& all() const { return leases_; }

    // ---- The iterations

    /// A result was committed: leases that can no longer be committed in full end, except for `by`.
    void committed(const LeaseEntry& by, const BlockResult& result);
    void uncommitted(const IterationSet& iterations);
    /// Nobody needs the iterations any more, though there is no result: `committed` says so already.
    void dropped(const IterationRange& range);
    /// The lowest iteration of the range that no node has begun to render, as far as is known: those that are neither
    /// committed nor in a lease, and those of leases that wait behind others. The range's end where there is none.
    uint64_t firstNotBegun(const IterationRange& range) const;
    /// Iterations that are rendered of leases within the range.
    uint64_t inHand(const IterationRange& range) const;
    uint64_t end() const { return end_; }
    /// Nothing at or beyond `end` is needed. Only ever lowers the end.
    void setEnd(uint64_t end);
    BlockPool& pool() { return pool_; }

    // ---- Predictions, in seconds; nothing where the node's speed is unknown

    /// Until the node has rendered this lease of its queue.
    std::optional<double> remaining(const LeaseEntry& entry, double now) const;
    /// Until the node would have rendered `count` further iterations after all that it holds.
    std::optional<double> predicted(const NodeEntry& node, uint64_t count, double now) const;

private:
    double patience(const LeaseEntry& entry) const;
    /// The clock of the lease that comes next in the node's queue starts when the one before it is done.
    void advance(NodeEntry& node, double now);
    void observe(LeaseEntry& entry, uint64_t done, double now);
    void release(LeaseEntry& entry);
    void reclaim(LeaseEntry& entry);
    void giveBack(const IterationRange& range);
    void expire(LeaseEntry& entry);
    /// The lease will not be in the image, for all that is known now.
    void lose(LeaseEntry& entry);

    const CoordinatorOptions options_;
    const IterationSet& committed_;
    Messages& messages_;
    uint64_t end_;
    BlockPool pool_;
    std::map<NodeId, NodeEntry> nodes_;
    std::map<LeaseId, LeaseEntry> leases_;  ///< by age
    LeaseId nextLease_ = 1;
};

}  // namespace antipode
