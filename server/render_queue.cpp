#include "server/render_queue.h"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include "proto/wire/frame.h"
#include "proto/wire/job_messages.h"
#include "server/admission.h"

namespace antipode {
namespace {

constexpr uint64_t iterationsEnd = 1ull << 40;

const std::string drainReason = "The server is going down.";

struct Lease {
    uint64_t id = 0;
    IterationRange range;
};

struct Job {
    std::string key;
    uint64_t generation = 0;  // tells it from an earlier job of the same key
    std::string identity;     // settings and scene, as bytes
    JobCosts costs;
    JobListener* listener = nullptr;
    double orphanSince = 0;  // where there is no listener
    std::optional<JobReady> ready;
    uint64_t leastLease = 0;                                         // that it may have next
    std::deque<Lease> waiting;                                       // ≤ leaseDepth, of the listener's connection
    std::map<uint64_t, std::shared_ptr<const BlockResult>> results;  // ≤ leaseDepth, of any connection
    double used = 0;                                                 // device seconds, see startNext()
    uint64_t lastStart = 0;                                          // orders those that have used the same
};

/// The block that the worker has.
struct BlockInHand {
    uint64_t generation = 0;
    Lease lease;
    bool ofEarlierConnection = false;
    bool truncated = false;
    std::string reason;               // why nothing comes of it, if nothing does
    std::optional<double> seenSince;  // first tick that saw it
};

}  // namespace

uint64_t resultBytesOf(const RenderQueueLimits& limits, const JobSize& size) {
    return limits.leaseDepth * size.pixels * size.channels * sizeof(int64_t);
}

struct RenderQueue::Impl : std::enable_shared_from_this<RenderQueue::Impl> {
    Impl(BlockWorker& worker, RenderQueueLimits limits, std::function<void(std::function<void()>)> post)
        : worker_(worker), limits_(limits), post_(std::move(post)) {}

    // ---- Worker

    static std::string workerKey(uint64_t generation) { return std::to_string(generation); }

    /// A callback for the worker's thread that runs `action` on the queue's, if there still is a queue.
    template <class Argument, class Action>
    auto posting(Action action) {
        using Value = std::decay_t<Argument>;
        return [post = post_, weak = weak_from_this(), action](Argument argument) {
            // Shared, because std::function asks for copies and results are large.
            post([weak, action, value = std::make_shared<Value>(std::move(argument))] {
                if (const auto queue = weak.lock()) action(*queue, *value);
            });
        };
    }

    // ---- Jobs

    Job* find(const std::string& key) {
        const auto job = jobs_.find(key);
        return job == jobs_.end() ? nullptr : &job->second;
    }
    Job* find(uint64_t generation) {
        for (auto& [key, job] : jobs_)
            if (job.generation == generation) return &job;
        return nullptr;
    }
    bool inHand(const Job& job) const { return hand_ && hand_->generation == job.generation; }
    /// An orphan that nobody would miss.
    bool evictable(const Job& job) const { return !job.listener && job.results.empty() && !inHand(job); }

    /// Builds that nobody waits for any more count as jobs, because the worker still has their scenes; and so does an
    /// evictable job that is being built.
    JobCosts held(bool evictablesGo) const {
        JobCosts costs{abandonedBuilds_, 0, 0, 0};
        for (const auto& [key, job] : jobs_) {
            if (!evictablesGo || !evictable(job))
                costs += job.costs;
            else if (!job.ready)
                ++costs.jobs;
        }
        return costs;
    }

    std::optional<farm::Refusal> admission(const JobSize& size, uint64_t sceneBytes) const {
        if (!deviceLoss_.empty()) return refusal(farm::Refusal::DEVICE_FAILED, deviceLoss_);
        if (draining_) return refusal(farm::Refusal::DRAINING, drainReason + " Use another one.");
        if (auto refused = refuseSize(limits_, size, sceneBytes)) return refused;
        return refuseCosts(
            limits_, held(true),
            {1, estimateDeviceBytes(size, limits_.bindingBytes), resultBytesOf(limits_, size), sceneBytes});
    }

    std::optional<farm::Refusal> open(const std::string& key, const farm::JobSettings& message,
                                      const std::string& sceneHash, std::shared_ptr<const Scene> scene,
                                      uint64_t deviceBytes, uint64_t sceneBytes, JobListener& listener) {
        if (!deviceLoss_.empty()) return refusal(farm::Refusal::DEVICE_FAILED, deviceLoss_);
        const std::string identity = message.SerializeAsString() + sceneHash;
        if (Job* job = find(key)) {
            if (job->identity != identity)
                return refusal(farm::Refusal::BAD_JOB,
                               "The job is open with other settings or another scene: start it under another name.");
            attach(*job, listener);
            return {};
        }
        RenderSettings settings;
        try {
            settings = wire::fromMessage(message);
        } catch (const Error& error) {
            return refusal(farm::Refusal::BAD_JOB, error.what());
        }
        Job job;
        job.key = key;
        job.generation = ++generations_;
        job.identity = identity;
        job.costs = {1, deviceBytes, resultBytesOf(limits_, sizeOf(settings)), sceneBytes};
        job.listener = &listener;
        if (auto refused = refuseCosts(limits_, held(true), job.costs)) return refused;
        makeRoom(job.costs);
        const uint64_t generation = job.generation;
        jobs_.emplace(key, std::move(job));
        ++builds_;
        worker_.openJob(workerKey(generation), std::move(scene), settings,
                        posting<const JobReady&>(
                            [generation](Impl& queue, const JobReady& ready) { queue.built(generation, ready); }),
                        posting<const Error&>(
                            [generation](Impl& queue, const Error& error) { queue.notBuilt(generation, error); }));
        return {};
    }

    /// Closes orphans, the oldest first, until a job fits in that would fit in without them.
    void makeRoom(const JobCosts& asked) {
        while (refuseCosts(limits_, held(false), asked)) {
            Job* oldest = nullptr;
            for (auto& [key, job] : jobs_)
                if (evictable(job) && (!oldest || job.orphanSince < oldest->orphanSince)) oldest = &job;
            close(*oldest);
        }
    }

    void attach(Job& job, JobListener& listener) {
        forgetConnection(job);
        if (JobListener* older = std::exchange(job.listener, &listener)) older->jobTaken();
        if (job.ready) listener.jobReady(*job.ready);
        for (const auto& [lease, result] : job.results) listener.resultReady(lease);
    }

    void detach(const std::string& key, const JobListener& listener, double now) {
        Job* job = find(key);
        if (!job || job->listener != &listener) return;
        job->listener = nullptr;
        job->orphanSince = now;
        forgetConnection(*job);
    }

    void forgetConnection(Job& job) {
        job.waiting.clear();
        if (inHand(job)) hand_->ofEarlierConnection = true;
    }

    void close(Job& job) {
        if (inHand(job)) truncateHand();
        if (!job.ready) ++abandonedBuilds_;
        worker_.closeJob(workerKey(job.generation));
        jobs_.erase(jobs_.find(job.key));
    }

    void built(uint64_t generation, const JobReady& ready) {
        --builds_;
        totals_.busySeconds += ready.seconds;
        Job* job = find(generation);
        if (job)
            job->ready = ready;
        else
            --abandonedBuilds_;
        startNext();
        if (job && job->listener) job->listener->jobReady(ready);
    }

    void notBuilt(uint64_t generation, const Error& error) {
        --builds_;
        if (find(generation))
            failed(generation, error);
        else
            --abandonedBuilds_;
        startNext();
    }

    /// The worker has lost the job's renderer.
    void failed(uint64_t generation, const Error& error) {
        const auto job = std::find_if(jobs_.begin(), jobs_.end(),
                                      [generation](const auto& j) { return j.second.generation == generation; });
        if (job == jobs_.end()) return;
        std::deque<Lease> unanswered = std::move(job->second.waiting);
        if (inHand(job->second) && !hand_->ofEarlierConnection) unanswered.push_front(hand_->lease);
        JobListener* listener = job->second.listener;
        jobs_.erase(job);
        if (!listener) return;
        for (const Lease& lease : unanswered) listener->leaseReturned(lease.id, error.what());
        listener->jobFailed(error);
    }

    // ---- Leases

    void lease(const std::string& key, uint64_t id, IterationRange range) {
        Job* job = find(key);
        if (!job || !job->ready || !job->listener)
            throw wire::ProtocolError("A lease came for a job that is not ready.");
        if (id < job->leastLease || id == UINT64_MAX)
            throw wire::ProtocolError("Lease " + std::to_string(id) + " came again or out of order.");
        if (range.count == 0 || range.first >= iterationsEnd || range.count > iterationsEnd - range.first)
            throw wire::ProtocolError("Lease " + std::to_string(id) + " has no iterations, or some beyond 2^40.");
        const size_t ours = inHand(*job) && !hand_->ofEarlierConnection ? 1 : 0;
        if (job->waiting.size() + ours >= limits_.leaseDepth)
            throw wire::ProtocolError("More than " + std::to_string(limits_.leaseDepth) +
                                      " leases wait for an answer.");
        job->leastLease = id + 1;
        if (draining_) return job->listener->leaseReturned(id, drainReason);
        job->waiting.push_back({id, range});
        startNext();
    }

    void truncate(const std::string& key, uint64_t id) {
        Job* job = find(key);
        if (!job) return;
        if (inHand(*job) && hand_->lease.id == id) return truncateHand();
        if (std::erase_if(job->waiting, [id](const Lease& lease) { return lease.id == id; }) && job->listener)
            job->listener->leaseReturned(id, "");
    }

    void truncateHand() {
        if (!std::exchange(hand_->truncated, true)) worker_.truncateBlock();
    }

    void settle(const std::string& key, uint64_t lease) {
        Job* job = find(key);
        if (job && job->results.erase(lease)) startNext();
    }

    bool eligible(const Job& job) const {
        return job.ready && !job.waiting.empty() && job.results.size() < limits_.leaseDepth;
    }

    /// Start-time fair queueing (Goyal, Vin & Cheng 1996): `virtualTime_` is what the job that was served last had used
    /// at its start. A job that comes new or was away is lifted to it, so that it can claim nothing for the past.
    void startNext() {
        // A block is never queued behind a build, so that a truncation always means the one block that the worker has.
        if (hand_ || builds_ > 0) return;
        Job* next = nullptr;
        for (auto& [key, job] : jobs_) {
            if (!eligible(job)) continue;
            job.used = std::max(job.used, virtualTime_);
            if (!next || std::pair(job.used, job.lastStart) < std::pair(next->used, next->lastStart)) next = &job;
        }
        if (!next) return;
        virtualTime_ = next->used;
        next->lastStart = ++starts_;
        const uint64_t generation = next->generation;
        hand_ = BlockInHand{generation, next->waiting.front(), false, false, "", {}};
        next->waiting.pop_front();
        worker_.renderBlock(
            workerKey(generation), hand_->lease.range,
            {.progress =
                 posting<uint64_t>([generation](Impl& queue, uint64_t done) { queue.progressed(generation, done); }),
             .finished = posting<std::optional<BlockResult>>(
                 [](Impl& queue, std::optional<BlockResult>& result) { queue.finished(std::move(result)); }),
             .failed = posting<const Error&>([](Impl& queue, const Error& error) { queue.deviceLost(error); })});
    }

    /// A device that fails in the middle of a block may fail, or render wrongly, whatever comes next.
    void deviceLost(const Error& error) {
        deviceLoss_ = std::string("The server's device failed in the middle of a block: ") + error.what();
        const Error told(ErrorCode::Device, deviceLoss_);
        while (!jobs_.empty()) {
            const uint64_t generation = jobs_.begin()->second.generation;
            if (inHand(jobs_.begin()->second) || jobs_.begin()->second.ready)
                worker_.closeJob(workerKey(generation));
            else
                ++abandonedBuilds_;
            failed(generation, told);
        }
        hand_.reset();
    }

    void progressed(uint64_t generation, uint64_t done) {
        const Job* job = find(generation);
        if (job && job->listener && !hand_->ofEarlierConnection) job->listener->progress(hand_->lease.id, done);
    }

    void finished(std::optional<BlockResult> result) {
        const BlockInHand block = *std::exchange(hand_, std::nullopt);
        if (result) {
            ++totals_.blocks;
            totals_.iterations += result->range.count;
            totals_.busySeconds += result->seconds;
        }
        Job* job = find(block.generation);
        if (job && result) {
            job->used += result->seconds;
            job->results.emplace(block.lease.id, std::make_shared<const BlockResult>(std::move(*result)));
        }
        startNext();
        if (!job || !job->listener) return;
        if (result)
            job->listener->resultReady(block.lease.id);
        else if (!block.ofEarlierConnection)
            job->listener->leaseReturned(block.lease.id, block.reason);
    }

    // ---- Time

    void tick(double now) {
        for (auto next = jobs_.begin(); next != jobs_.end();) {
            Job& job = (next++)->second;
            if (!job.listener && now - job.orphanSince >= limits_.orphanSeconds) close(job);
        }
        if (!hand_) return;
        if (!hand_->seenSince) hand_->seenSince = now;
        const bool othersWait = std::any_of(jobs_.begin(), jobs_.end(), [this](const auto& entry) {
            return entry.second.generation != hand_->generation && eligible(entry.second);
        });
        if (othersWait && now - *hand_->seenSince >= limits_.blockSeconds) truncateHand();
    }

    void drain() {
        draining_ = true;
        if (hand_) {
            hand_->reason = drainReason;
            truncateHand();
        }
        for (auto& [key, job] : jobs_)
            for (const Lease& lease : std::exchange(job.waiting, {}))
                if (job.listener) job.listener->leaseReturned(lease.id, drainReason);
    }

    bool idle() const {
        return !hand_ && std::none_of(jobs_.begin(), jobs_.end(), [](const auto& entry) {
            return entry.second.listener && !entry.second.results.empty();
        });
    }

    BlockWorker& worker_;
    const RenderQueueLimits limits_;
    const std::function<void(std::function<void()>)> post_;
    std::map<std::string, Job> jobs_;
    std::optional<BlockInHand> hand_;
    uint32_t builds_ = 0, abandonedBuilds_ = 0;  // asked for and not answered; of these, without a job
    uint64_t generations_ = 0, starts_ = 0;
    double virtualTime_ = 0;
    bool draining_ = false;
    std::string deviceLoss_;
    Totals totals_;
};

RenderQueue::RenderQueue(BlockWorker& worker, RenderQueueLimits limits, std::function<void(std::function<void()>)> post)
    : impl_(std::make_shared<Impl>(worker, limits, std::move(post))) {}
RenderQueue::~RenderQueue() = default;

std::optional<farm::Refusal> RenderQueue::admission(const JobSize& size, uint64_t sceneBytes) const {
    return impl_->admission(size, sceneBytes);
}

uint64_t RenderQueue::estimate(const JobSize& size) const {
    return estimateDeviceBytes(size, impl_->limits_.bindingBytes);
}

bool RenderQueue::knows(const std::string& job) const { return impl_->find(job); }

std::optional<farm::Refusal> RenderQueue::open(const std::string& job, const farm::JobSettings& settings,
                                               const std::string& sceneHash, std::shared_ptr<const Scene> scene,
                                               uint64_t estimatedDeviceBytes, uint64_t sceneBytes,
                                               JobListener& listener) {
    return impl_->open(job, settings, sceneHash, std::move(scene), estimatedDeviceBytes, sceneBytes, listener);
}

void RenderQueue::detach(const std::string& job, const JobListener& listener, double now) {
    impl_->detach(job, listener, now);
}

void RenderQueue::close(const std::string& job) {
    if (Job* open = impl_->find(job)) impl_->close(*open);
}

void RenderQueue::lease(const std::string& job, uint64_t lease, IterationRange range) {
    impl_->lease(job, lease, range);
}

void RenderQueue::truncate(const std::string& job, uint64_t lease) { impl_->truncate(job, lease); }

std::shared_ptr<const BlockResult> RenderQueue::result(const std::string& job, uint64_t lease) const {
    const Job* open = impl_->find(job);
    if (!open) return nullptr;
    const auto result = open->results.find(lease);
    return result == open->results.end() ? nullptr : result->second;
}

void RenderQueue::settle(const std::string& job, uint64_t lease) { impl_->settle(job, lease); }

bool RenderQueue::settled(const std::string& job) const {
    const Job* open = impl_->find(job);
    return !open || (open->waiting.empty() && open->results.empty() && !impl_->inHand(*open));
}

void RenderQueue::tick(double now) { impl_->tick(now); }
void RenderQueue::drain() { impl_->drain(); }
bool RenderQueue::idle() const { return impl_->idle(); }
const std::string& RenderQueue::deviceLoss() const { return impl_->deviceLoss_; }

RenderQueue::Totals RenderQueue::totals() const {
    Totals totals = impl_->totals_;
    totals.jobs = impl_->jobs_.size();
    for (const auto& [key, job] : impl_->jobs_) totals.waitingResults += job.results.size();
    return totals;
}

}  // namespace antipode
