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
    double orphanSince = 0;                                          // where there is no listener
    std::optional<JobReady> ready;                                   // with its present width
    uint64_t leastLease = 0;                                         // that it may have next
    std::deque<Lease> waiting;                                       // ≤ leaseDepth, of the listener's connection
    std::map<uint64_t, std::shared_ptr<const BlockResult>> results;  // ≤ leaseDepth, of any connection
    double used = 0;                                                 // device seconds, see startNext()
    uint64_t lastStart = 0;                                          // orders those that have used the same
};

/// A block that the worker has.
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
        : worker_(worker), atOnce_(worker.blocksAtOnce()), limits_(limits), post_(std::move(post)) {}

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
    /// Calls `action` with each block of the job that is in hand.
    template <class Action>
    void forHands(const Job& job, const Action& action) {
        for (BlockInHand& hand : hands_)
            if (hand.generation == job.generation) action(hand);
    }
    size_t handsOf(const Job& job) const {
        return size_t(std::ranges::count(hands_, job.generation, &BlockInHand::generation));
    }
    bool inHand(const Job& job) const { return handsOf(job) > 0; }
    BlockInHand* hand(uint64_t generation, uint64_t first) {
        const auto found = std::ranges::find_if(hands_, [&](const BlockInHand& hand) {
            return hand.generation == generation && hand.lease.range.first == first;
        });
        return found == hands_.end() ? nullptr : &*found;
    }
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
        forHands(job, [](BlockInHand& hand) { hand.ofEarlierConnection = true; });
    }

    void close(Job& job) {
        forHands(job, [this](BlockInHand& hand) { truncate(hand); });
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

    /// Or, after that, failed on its own.
    void notBuilt(uint64_t generation, const Error& error) {
        const Job* job = find(generation);
        if (!job || !job->ready) --builds_;
        if (job)
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
        forHands(job->second, [&](const BlockInHand& hand) {
            if (!hand.ofEarlierConnection) unanswered.push_front(hand.lease);
        });
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
        size_t ours = 0;
        forHands(*job, [&](const BlockInHand& hand) { ours += !hand.ofEarlierConnection; });
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
        const auto inHand = std::ranges::find_if(
            hands_, [&](const BlockInHand& hand) { return hand.generation == job->generation && hand.lease.id == id; });
        if (inHand != hands_.end()) return truncate(*inHand);
        if (std::erase_if(job->waiting, [id](const Lease& lease) { return lease.id == id; }) && job->listener)
            job->listener->leaseReturned(id, "");
    }

    void truncate(BlockInHand& hand) {
        if (!std::exchange(hand.truncated, true))
            worker_.truncateBlock(workerKey(hand.generation), hand.lease.range.first);
    }

    void settle(const std::string& key, uint64_t lease) {
        Job* job = find(key);
        if (job && job->results.erase(lease)) startNext();
    }

    bool eligible(const Job& job) const {
        const size_t hands = handsOf(job);
        if (!job.ready || job.waiting.empty() || hands >= atOnce_.ofJob ||
            job.results.size() + hands >= limits_.leaseDepth)
            return false;
        const IterationRange& next = job.waiting.front().range;
        return std::ranges::none_of(hands_, [&](const BlockInHand& hand) {
            const IterationRange& other = hand.lease.range;
            return hand.generation == job.generation && next.first < other.end() && other.first < next.end();
        });
    }

    /// Start-time fair queueing (Goyal, Vin & Cheng 1996): `virtualTime_` is what the job that was served last had used
    /// at its start. A job that comes new or was away is lifted to it, so that it can claim nothing for the past.
    void startNext() {
        while (startOne()) continue;
    }

    bool startOne() {
        // Where there is one block at a time it is never queued behind a build, so that a truncation means that one.
        if (hands_.size() >= atOnce_.all || (atOnce_.all == 1 && builds_ > 0)) return false;
        Job* next = nullptr;
        for (auto& [key, job] : jobs_) {
            if (!eligible(job)) continue;
            job.used = std::max(job.used, virtualTime_);
            if (!next || std::pair(job.used, job.lastStart) < std::pair(next->used, next->lastStart)) next = &job;
        }
        if (!next) return false;
        virtualTime_ = next->used;
        next->lastStart = ++starts_;
        const uint64_t generation = next->generation;
        const IterationRange range = next->waiting.front().range;
        hands_.push_back({generation, next->waiting.front(), false, false, "", {}});
        next->waiting.pop_front();
        const uint64_t first = range.first;
        worker_.renderBlock(
            workerKey(generation), range,
            {.progress = posting<uint64_t>(
                 [generation, first](Impl& queue, uint64_t done) { queue.progressed(generation, first, done); }),
             .finished = posting<std::optional<BlockResult>>(
                 [generation, first](Impl& queue, std::optional<BlockResult>& result) {
                     queue.finished(generation, first, std::move(result));
                 }),
             .failed = posting<const Error&>([](Impl& queue, const Error& error) { queue.deviceLost(error); })});
        return true;
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
        hands_.clear();
    }

    void progressed(uint64_t generation, uint64_t first, uint64_t done) {
        const Job* job = find(generation);
        const BlockInHand* block = hand(generation, first);
        if (job && job->listener && block && !block->ofEarlierConnection)
            job->listener->progress(block->lease.id, done);
    }

    void widened(const std::string& key, uint32_t width) {
        const auto job =
            std::ranges::find_if(jobs_, [&](const auto& entry) { return workerKey(entry.second.generation) == key; });
        if (job == jobs_.end() || !job->second.ready) return;
        job->second.ready->width = width;
        if (job->second.listener) job->second.listener->widthChanged(width);
    }

    void finished(uint64_t generation, uint64_t first, std::optional<BlockResult> result) {
        const BlockInHand block = *hand(generation, first);
        std::erase_if(hands_, [&](const BlockInHand& other) {
            return other.generation == generation && other.lease.range.first == first;
        });
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
        for (BlockInHand& hand : hands_) {
            if (!hand.seenSince) hand.seenSince = now;
            const bool othersWait = std::ranges::any_of(jobs_, [&](const auto& entry) {
                return entry.second.generation != hand.generation && eligible(entry.second);
            });
            if (othersWait && now - *hand.seenSince >= limits_.blockSeconds) truncate(hand);
        }
    }

    void drain() {
        draining_ = true;
        for (BlockInHand& hand : hands_) {
            hand.reason = drainReason;
            truncate(hand);
        }
        for (auto& [key, job] : jobs_)
            for (const Lease& lease : std::exchange(job.waiting, {}))
                if (job.listener) job.listener->leaseReturned(lease.id, drainReason);
    }

    bool idle() const {
        return hands_.empty() && std::none_of(jobs_.begin(), jobs_.end(), [](const auto& entry) {
                   return entry.second.listener && !entry.second.results.empty();
               });
    }

    BlockWorker& worker_;
    const BlocksAtOnce atOnce_;
    const RenderQueueLimits limits_;
    const std::function<void(std::function<void()>)> post_;
    std::map<std::string, Job> jobs_;
    std::vector<BlockInHand> hands_;
    uint32_t builds_ = 0, abandonedBuilds_ = 0;  // asked for and not answered; of these, without a job
    uint64_t generations_ = 0, starts_ = 0;
    double virtualTime_ = 0;
    bool draining_ = false;
    std::string deviceLoss_;
    Totals totals_;
};

RenderQueue::RenderQueue(BlockWorker& worker, RenderQueueLimits limits, std::function<void(std::function<void()>)> post)
    : impl_(std::make_shared<Impl>(worker, limits, std::move(post))) {
    worker.tellWidth([post = impl_->post_, weak = std::weak_ptr(impl_)](const std::string& job, uint32_t width) {
        post([weak, job, width] {
            if (const auto queue = weak.lock()) queue->widened(job, width);
        });
    });
}
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
