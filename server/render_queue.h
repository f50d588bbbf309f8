// The jobs of a server: whose block is rendered next, and which results wait to be fetched.
//
// Pure but for the worker: one thread, times by parameter. Fair: the device goes to the job that has used it least
// since the others came. A job outlives its connection for a while, so that a client that reconnects finds its results.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/farm.pb.h"
#include "renderengine/block_worker.h"
#include "renderengine/engine.h"

namespace antipode {

struct RenderQueueLimits {
    uint32_t jobs = 16;                ///< open at once, connected or not
    uint32_t leaseDepth = 2;           ///< leases without an answer that a job holds at once, and results likewise
    uint64_t pixels = 1ull << 26;      ///< of an image; light paths of an iteration likewise
    uint64_t sceneBytes = 8ull << 30;  ///< of this machine's memory for the scenes of all jobs
    uint64_t deviceBytes = 0;  ///< of all renderers together; 0 is no bound: the server knows its device's memory
    uint64_t bindingBytes = UINT64_MAX;  ///< largest buffer of the device, for the estimates
    uint64_t resultBytes = 8ull << 30;   ///< of this machine's memory for the results of all jobs, see resultBytesOf
    double orphanSeconds = 120;          ///< that a job without connection is kept
    double blockSeconds = 30;            ///< after which a block is cut short if another job waits
};

/// What the results of a job take at most: leaseDepth of them, one being rendered among these.
uint64_t resultBytesOf(const RenderQueueLimits& limits, const JobSize& size);

/// What a job's connection is told. Called on the queue's thread, from within the queue's functions, too; calls nothing
/// but the queue's const functions and detach() in turn.
class JobListener {
public:
    virtual ~JobListener() = default;
    virtual void jobReady(const JobReady& ready) = 0;
    virtual void jobFailed(const Error& error) = 0;
    /// So many iterations are rendered side by side from now on.
    virtual void widthChanged(uint32_t width) = 0;
    virtual void progress(uint64_t lease, uint64_t done) = 0;
    /// A result waits, see RenderQueue::result.
    virtual void resultReady(uint64_t lease) = 0;
    virtual void leaseReturned(uint64_t lease, const std::string& reason) = 0;
    /// Another connection has opened the job: this one hears nothing more of it and has no say in it any more.
    virtual void jobTaken() = 0;
};

/// At most as many blocks are in the worker's hand as it says. Next comes the first waiting lease of the job that has
/// used the device least; a job that was away gets no more than its share for that (start-time fair queueing). A job
/// renders only while fewer than leaseDepth of its results wait to be settled, so a client that does not fetch slows
/// down no one but itself.

class RenderQueue {
public:
    /// `post` runs a function on the queue's thread, later; the worker's callbacks pass through it. The worker outlives
    /// the queue.
    RenderQueue(BlockWorker& worker, RenderQueueLimits limits, std::function<void(std::function<void()>)> post);
    ~RenderQueue();

    /// Why a job cannot be taken now: a sentence with its code; nothing where it can. Known before anything is loaded.
    /// Orphans without results are no obstacle: open() closes them to make room.
    std::optional<farm::Refusal> admission(const JobSize& size, uint64_t sceneBytes) const;

    /// What such a job is expected to take of the device, in bytes.
    uint64_t estimate(const JobSize& size) const;

    /// Whether the job is open: a client that comes back then needs no scene.
    bool knows(const std::string& job) const;
    /// Opens a job, or takes over one that is known, which needs no scene. Results that wait are announced again;
    /// leases of an earlier connection that wait are forgotten. Why it is not taken, where it is not: BAD_JOB for a
    /// known job with other settings or another scene and for settings that no engine takes, admission()'s code where
    /// there is no room; then nothing has changed.
    [[nodiscard]] std::optional<farm::Refusal> open(const std::string& job, const farm::JobSettings& settings,
                                                    const std::string& sceneHash, std::shared_ptr<const Scene> scene,
                                                    uint64_t estimatedDeviceBytes, uint64_t sceneBytes,
                                                    JobListener& listener);
    /// The connection is gone. Its lease in hand is rendered to the end, those that wait are forgotten. Nothing happens
    /// where another listener has the job.
    void detach(const std::string& job, const JobListener& listener, double now);
    void close(const std::string& job);

    /// Throws wire::ProtocolError where leaseDepth of them wait for an answer already, for one that is not above all
    /// leases that the job has had, and for a range that is empty or beyond 2^40. Those of an earlier connection do not
    /// count.
    void lease(const std::string& job, uint64_t lease, IterationRange range);
    /// Ignores a lease that neither waits nor is in hand: its answer is on its way.
    void truncate(const std::string& job, uint64_t lease);
    /// The result of a lease, until it is settled. Null where there is none.
    std::shared_ptr<const BlockResult> result(const std::string& job, uint64_t lease) const;
    /// Forgets the result.
    void settle(const std::string& job, uint64_t lease);

    /// No lease and no result of the job is left.
    bool settled(const std::string& job) const;

    /// Closes orphans whose time is up, and cuts a block short that has taken long while another job waits.
    void tick(double now);
    /// Takes no lease any more, truncates the block in hand, returns those that wait.
    void drain();
    /// Nothing is rendered and no result of a connected job waits.
    bool idle() const;
    /// How the device was lost, in mid-block; empty while it is not. All jobs have been told then and are gone, and
    /// none is taken any more: what the device says after that means nothing, and only a new process may have it again.
    const std::string& deviceLoss() const;

    struct Totals {
        uint64_t iterations = 0, blocks = 0, jobs = 0, waitingResults = 0;
        double busySeconds = 0;  ///< of rendering and building
    };
    Totals totals() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;  // callbacks of the worker may outlive the queue
};

}  // namespace antipode
