// One job on any number of nodes: hands out blocks of iterations, commits each iteration exactly once.
//
// Pure: no clock, no thread, no socket. Times are monotonic seconds from one origin. Nodes are reached through
// NodePort; the local device and remote servers differ in nothing else. All calls on one thread; NodePort's functions
// are called from within them and must not call back.
//
// Commit rule: a result is committed if and only if no iteration of its range is committed yet, its range is a prefix
// of a block that its node was granted in this job, and its sums match the hash, the size and the scale of the job. A
// node three of whose results in a row are refused is not used any more: what it is asked for again comes out the same.
// A result of a lease that expired, or of a connection that was lost, is as good as any other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "farm/jobs/checkpoint.h"
#include "farm/jobs/coordinator_options.h"
#include "farm/jobs/iteration_set.h"
#include "farm/jobs/job_definition.h"
#include "farm/jobs/node_port.h"
#include "renderengine/block_worker.h"

namespace antipode {

enum class Verdict { Committed, NotNeeded, Rejected };

/// A node as people want to see it.
struct NodeStatus {
    NodeId id = 0;
    NodeDescription description;
    enum class State { Idle, Rendering, Stalled, Gone, Quarantined } state = State::Idle;
    double iterationsPerSecond = 0;  ///< measured, smoothed
    uint32_t leases = 0;             ///< outstanding
    uint64_t inHand = 0;             ///< iterations rendered of outstanding leases, by its progress reports
    uint64_t committed = 0;          ///< iterations of it in the image
    uint64_t results = 0;            ///< blocks that these came in
    uint64_t lost = 0;               ///< iterations leased in vain: expired, disconnected, duplicated, rejected …
    std::string quarantine;          ///< why it is in quarantine
};

class Coordinator {
public:
    /// `start`: what a checkpoint of the same job has committed already. Throws Error(Usage) where it is of another job
    /// or holds more than the iterations that are asked for.
    Coordinator(JobDefinition job, CoordinatorOptions options, std::optional<Checkpoint> start = {});
    ~Coordinator();

    // ---- Nodes

    /// A node is ready for leases. The port must outlive removeNode(). A node that was removed keeps its id by its
    /// name.
    NodeId addNode(const NodeDescription& description, NodePort& port, double now);
    /// Its leases go back to the pool; results of them are still welcome when it returns.
    void removeNode(NodeId node, double now);
    /// The node takes no more leases; answers to those that it has are still to come. addNode() takes this back.
    void retireNode(NodeId node, double now);
    /// The node renders so many iterations side by side from now on; 0: it can be given nothing.
    void setWidth(NodeId node, uint32_t width, double now);
    /// `done` iterations of the lease's block are rendered.
    void progress(NodeId node, LeaseId lease, uint64_t done, double now);
    /// The node gives the lease back without a result.
    void returned(NodeId node, LeaseId lease, double now);
    /// Before a result is transferred: whether deliver() would commit it (or cross-check it: that needs the hash alone
    /// and is done here). `sha256`: 64 hexadecimal digits. Where not, the lease is settled.
    bool wanted(NodeId node, LeaseId lease, IterationRange range, const std::string& sha256, double now);
    /// A result, its hash already verified against its sums. Settles the lease.
    Verdict deliver(NodeId node, LeaseId lease, const BlockResult& result, double now);
    /// The node's result was broken or did not match its offer. Settles the lease; its range goes back to the pool.
    void reject(NodeId node, LeaseId lease, double now);

    // ---- Time

    /// Expires leases and hands out new ones. To be called a few times a second, and after any of the above.
    void tick(double now);
    /// Ends an unlimited job: nothing new is begun beyond what has been delivered; gaps below are still rendered, so
    /// that the image is a prefix of all iterations. Blocks in hand are truncated.
    void finishEarly(double now);
    /// Until it is called again, leases nothing at or beyond `end`: who decides by the image after so many iterations
    /// whether there are more sees that image on every farm, and nobody renders what may not be wanted.
    void holdAt(uint64_t end);
    /// Ends the job as it is: truncates all blocks in hand and leases nothing more. Results are still accepted.
    void stop(double now);

    // ---- Blocks that are asked for (CoordinatorOptions::inParts)

    /// Has a block rendered, none of whose iterations is in another one.
    void ask(IterationRange block);
    /// Begins nothing more of the block: what nodes render of it, or have rendered, is its result, and what is needed
    /// before that for a prefix.
    void cut(uint64_t first, double now);
    /// Iterations of the block that are rendered, by results and progress reports.
    uint64_t rendered(uint64_t first) const;
    /// First iterations of blocks of which nothing more is to come, verified where that is asked for.
    std::vector<uint64_t> finishedParts() const;
    /// Ends a block and gives what there is of it, whose sums are not hashed yet; nothing where it was cut before its
    /// first iteration.
    std::optional<BlockResult> takePart(uint64_t first, double now);
    /// Iterations that all nodes together render side by side now.
    uint32_t width() const;
    /// What all renderings of the job are equal to; empty before the first node.
    const std::string& renderingClass() const;

    // ---- Results

    /// All of [0, N) is committed (and, with verification, agreed upon).
    bool complete() const;
    /// Leases that are neither settled nor expired nor lost with their connection: each becomes one of these in time.
    uint32_t outstanding() const;
    /// Sums of everything committed; iterations == committed().count(). Empty sums before the first result.
    const FilmSums& sums() const;
    const IterationSet& committed() const;
    EngineStatistics statistics() const;
    Checkpoint checkpoint(double wallSeconds) const;
    /// Why iterations that are missing can be in no image: a sentence, empty while nothing is known against them. No
    /// lease is given out any more then.
    const std::string& failure() const;
    /// How often two nodes of one class have rendered a block differently.
    uint64_t hashMismatches() const;

    std::vector<NodeStatus> nodes() const;
    /// What the user must know, each once: stalled or quarantined nodes, hashes that differ … Returns and forgets.
    std::vector<std::string> takeMessages();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode
