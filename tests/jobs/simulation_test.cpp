// Thousands of jobs on farms that go wrong in every way, each replayed from its seed: whatever happens, the image holds
// every iteration exactly once, and the job ends.
#include <chrono>
#include <memory>
#include <set>
#include <utility>

#include "tests/jobs/job_fixture.h"
#include "tests/support/random.h"

using namespace antipode;
using namespace antipode::test;

namespace {

constexpr double quietAfter = 400;  ///< seconds, from when on nothing goes wrong any more
constexpr double longest = 200000;  ///< seconds that a job may take, where one slow node verifies a fast one

struct Plan {
    CoordinatorOptions options;
    std::optional<double> finishAt, stopAt, restartAt;
    bool withLiars = false;
};

/// A server and its connection: renders in order, loses its connection, stands still, delivers late or nonsense.
class SimulatedNode final : public NodePort {
public:
    SimulatedNode(const JobDefinition& job, Random& random, int index, bool liar, bool steady)
        : job_(job), random_(random), steady_(steady), lie_(liar ? index + 1 : 0) {
        description_ = {"node" + std::to_string(index), "device", index % 4 == 3 ? "other" : "class",
                        1 + random.index(3)};
        if (liar || steady) description_.deviceClass = "class";
        secondsPerIteration_ = std::exp(random.uniform(std::log(0.02), std::log(4.0)));
        if (random.uniform() < 0.1) secondsPerIteration_ *= 20;
        joinAt_ = steady ? 0 : random.uniform(-30, 60);
    }

    void grant(const Lease& lease) override {
        EXPECT_TRUE(connected_);
        EXPECT_GE(lease.range.count, 1u);
        held_.insert(lease.id);
        EXPECT_LE(held_.size(), description_.leaseDepth) << description_.name;
        queue_.push_back({lease, 0, false});
    }
    void truncate(LeaseId lease) override {
        EXPECT_TRUE(held_.count(lease)) << "only what it holds can be truncated";
        for (Work& work : queue_)
            if (work.lease.id == lease) work.truncated = true;
    }

    void step(Coordinator& coordinator, double now, double seconds) {
        const bool quiet = now > quietAfter;
        if (!connected_) {
            if (now < joinAt_ && !quiet) return;
            id_ = coordinator.addNode(description_, *this, now);
            connected_ = true;
            stillUntil_ = budget_ = 0;
            return;
        }
        if (!quiet && !steady_) {
            if (happens(0.002 * seconds)) stillUntil_ = now + random_.uniform(1, 200);
            if (happens(0.004 * seconds)) return disconnect(coordinator, now);
        }
        if (now < stillUntil_ && !quiet) return;
        render(coordinator, now, seconds, quiet);
        deliver(coordinator, now, quiet);
    }

    /// The client has been killed and started anew: it knows nothing of the leases that were.
    void forget() {
        connected_ = false;
        queue_.clear();
        finished_.clear();
        held_.clear();
    }

private:
    struct Work {
        Lease lease;
        uint64_t done;
        bool truncated;
    };
    struct Finished {
        LeaseId lease;
        IterationRange range;
        double due;
    };

    bool happens(double probability) { return random_.uniform() < probability; }

    /// What is finished may still be there when it comes back.
    void disconnect(Coordinator& coordinator, double now) {
        coordinator.removeNode(id_, now);
        connected_ = false;
        joinAt_ = now + random_.uniform(0, 60);
        queue_.clear();
        held_.clear();
        if (happens(0.5)) finished_.clear();
    }

    void settle(size_t index) {
        held_.erase(queue_[index].lease.id);
        queue_.erase(queue_.begin() + long(index));
    }

    void render(Coordinator& coordinator, double now, double seconds, bool quiet) {
        // A lease that must end before it has begun comes back at once.
        for (size_t i = 0; i < queue_.size(); ++i) {
            if (!queue_[i].truncated || queue_[i].done != 0) continue;
            const LeaseId lease = queue_[i].lease.id;
            settle(i--);
            coordinator.returned(id_, lease, now);
        }
        if (!quiet && !steady_ && !queue_.empty() && happens(0.002)) {
            const LeaseId lease = queue_.back().lease.id;
            settle(queue_.size() - 1);
            coordinator.returned(id_, lease, now);
        }
        for (budget_ += seconds; !queue_.empty() && budget_ >= secondsPerIteration_; budget_ -= secondsPerIteration_) {
            Work& work = queue_.front();
            ++work.done;
            if (happens(0.9)) coordinator.progress(id_, work.lease.id, work.done, now);
            // Now and then a server cuts a block short by itself.
            const bool cut = !quiet && happens(0.01);
            if (work.done < work.lease.range.count && !work.truncated && !cut) continue;
            const double delay = quiet || steady_ ? 0 : happens(0.02) ? random_.uniform(0, 300) : random_.uniform(0, 2);
            finished_.push_back({work.lease.id, {work.lease.range.first, work.done}, now + delay});
            queue_.erase(queue_.begin());
        }
        if (queue_.empty()) budget_ = 0;
    }

    void deliver(Coordinator& coordinator, double now, bool quiet) {
        for (size_t i = 0; i < finished_.size(); ++i) {
            if (finished_[i].due > now && !quiet) continue;
            const Finished finished = finished_[i];
            finished_.erase(finished_.begin() + long(i--));
            BlockResult result = resultOf(job_, finished.range);
            result.sums.values.back() += lie_;
            result.sha256 = result.sums.sha256();
            if (coordinator.wanted(id_, finished.lease, result.range, result.sha256, now))
                transfer(coordinator, finished.lease, std::move(result), now, quiet);
            held_.erase(finished.lease);
        }
    }

    void transfer(Coordinator& coordinator, LeaseId lease, BlockResult result, double now, bool quiet) {
        // Who is refused again and again is not used any more.
        const bool right = std::exchange(refused_, false);
        refused_ = !quiet && !right && happens(0.04);
        if (refused_ && happens(0.5)) return coordinator.reject(id_, lease, now);
        if (refused_) {
            BlockResult wrong = result;
            happens(0.5) ? ++wrong.sums.layout.width : ++wrong.range.first;
            EXPECT_EQ(coordinator.deliver(id_, lease, std::move(wrong), now), Verdict::Rejected);
            return;
        }
        EXPECT_EQ(coordinator.deliver(id_, lease, result, now), Verdict::Committed) << "it was wanted";
        if (!happens(0.05)) return;
        EXPECT_NE(coordinator.deliver(id_, lease, std::move(result), now), Verdict::Committed);
    }

    const JobDefinition& job_;
    Random& random_;
    const bool steady_;
    const int64_t lie_;
    NodeDescription description_;
    double secondsPerIteration_, joinAt_, stillUntil_ = 0, budget_ = 0;
    bool refused_ = false;  ///< its last result
    NodeId id_ = 0;
    bool connected_ = false;
    std::vector<Work> queue_;
    std::vector<Finished> finished_;
    std::set<LeaseId> held_;  ///< granted in this connection and not settled
};

Plan planOf(Random& random) {
    Plan plan;
    plan.options.targetSeconds = random.uniform(0.5, 6);
    plan.options.leastPatienceSeconds = random.uniform(2, 15);
    plan.options.firstPatienceSeconds = random.uniform(20, 120);
    plan.options.verifySeed = random.index(1000);
    plan.withLiars = random.uniform() < 0.25;
    plan.options.verifyFraction = plan.withLiars ? 1 : random.uniform() < 0.3 ? random.uniform() : 0;
    if (random.uniform() < 0.6) plan.options.iterations = 1 + random.index(600);
    if (!plan.options.iterations || random.uniform() < 0.2) plan.finishAt = random.uniform(0, 120);
    if (random.uniform() < 0.05) plan.stopAt = random.uniform(0, 120);
    // What a checkpoint holds is trusted, lies included.
    if (!plan.withLiars && random.uniform() < 0.3) plan.restartAt = random.uniform(0, 60);
    return plan;
}

struct Outcome {
    bool finished = false, restarted = false;
    bool verified = false;    ///< was to be, at least in part
    bool unverified = false;  ///< all is rendered, but a class had one node alone
    uint64_t lost = 0, quarantined = 0;
};

Outcome simulate(uint64_t seed) {
    Random random(seed);
    const JobDefinition job = smallJob();
    Plan plan = planOf(random);
    auto coordinator = std::make_unique<Coordinator>(job, plan.options);
    std::vector<std::unique_ptr<SimulatedNode>> nodes;
    const int honest = plan.withLiars ? 3 : 1, liars = plan.withLiars ? 1 + int(random.index(2)) : 0;
    const int others = int(random.index(6));
    for (int i = 0; i < honest + liars + others; ++i)
        nodes.push_back(std::make_unique<SimulatedNode>(job, random, i, i >= honest && i < honest + liars,
                                                        plan.withLiars && i < honest));
    const auto exact = [&] {
        const FilmSums expected = fakeSums(job.settings, coordinator->committed().ranges());
        return coordinator->committed().empty() ? coordinator->sums().iterations == 0
                                                : coordinator->sums().sha256() == expected.sha256();
    };
    Outcome outcome;
    bool stopped = false;
    double now = 0;
    while (now < longest) {
        // What is left to a slow node alone need not be watched closely.
        const double seconds = random.uniform(0.05, now > 2 * quietAfter ? 20 : 0.6);
        now += seconds;
        for (const auto& node : nodes) {
            node->step(*coordinator, now, seconds);
            if (random.uniform() < 0.5) coordinator->tick(now);
        }
        coordinator->tick(now);
        if (plan.finishAt && now >= *plan.finishAt) {
            coordinator->finishEarly(now);
            plan.finishAt.reset();
        }
        if (plan.stopAt && now >= *plan.stopAt) {
            coordinator->stop(now);
            stopped = true;
            plan.stopAt.reset();
        }
        if (plan.restartAt && now >= *plan.restartAt) {
            const Checkpoint kept = decodeCheckpoint(encodeCheckpoint(coordinator->checkpoint(now)));
            if (random.uniform() < 0.5)  // some of the last work is lost with the client
                for (const auto& node : nodes) node->step(*coordinator, now, seconds);
            if (!plan.options.iterations && !plan.finishAt) plan.finishAt = now + 20;
            coordinator = std::make_unique<Coordinator>(job, plan.options, kept);
            for (const auto& node : nodes) node->forget();
            plan.restartAt.reset();
            outcome.restarted = true;
        }
        const bool looks = random.uniform() < 0.02;
        EXPECT_TRUE(!looks || plan.withLiars || exact()) << "seed " << seed << " at " << now;
        coordinator->takeMessages();
        outcome.unverified = !coordinator->failure().empty();
        if (!coordinator->complete() && !outcome.unverified && !(stopped && coordinator->outstanding() == 0)) continue;
        outcome.finished = true;
        break;
    }
    outcome.verified = plan.options.verifyFraction > 0;
    for (const NodeStatus& node : coordinator->nodes()) {
        outcome.lost += node.lost;
        outcome.quarantined += node.state == NodeStatus::State::Quarantined;
    }
    EXPECT_TRUE(outcome.finished) << "seed " << seed;
    if (stopped && !coordinator->complete()) {
        EXPECT_TRUE(plan.withLiars || exact()) << "seed " << seed;
        return outcome;
    }
    EXPECT_TRUE(!outcome.unverified || plan.options.verifyFraction > 0) << "seed " << seed;
    // What is not verified may hold lies: that is why the job fails.
    EXPECT_TRUE(exact() || (outcome.unverified && plan.withLiars)) << "seed " << seed;
    EXPECT_EQ(coordinator->committed().prefix(), coordinator->committed().count()) << "seed " << seed;
    EXPECT_GE(coordinator->committed().count(), 1u) << "seed " << seed;
    EXPECT_EQ(coordinator->statistics().rays, coordinator->committed().count()) << "seed " << seed;
    return outcome;
}

}  // namespace

TEST(Simulation, EveryScheduleEndsWithEveryIterationOnce) {
    constexpr uint64_t schedules = 3000;
    uint64_t restarted = 0, withLosses = 0, withQuarantine = 0, verified = 0, unverified = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (uint64_t seed = 1; seed <= schedules; ++seed) {
        const Outcome outcome = simulate(seed);
        restarted += outcome.restarted;
        verified += outcome.verified;
        unverified += outcome.unverified;
        withLosses += outcome.lost > 0;
        withQuarantine += outcome.quarantined > 0;
        if (HasFailure()) {
            ADD_FAILURE() << "the first seed that fails is " << seed;
            return;
        }
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    // The faults do occur.
    EXPECT_GT(restarted, schedules / 10);
    EXPECT_GT(withLosses, schedules / 4);
    EXPECT_GT(withQuarantine, schedules / 10);
    EXPECT_GT(unverified, schedules / 100);
    // And most jobs that are verified do end: those of lonely classes of devices cannot.
    EXPECT_LT(unverified, verified / 2);
    std::printf(
        "%llu schedules in %.1f s: %llu with losses, %llu with quarantine, %llu with a restart, %llu of %llu "
        "unverified\n",
        static_cast<unsigned long long>(schedules), seconds.count(), static_cast<unsigned long long>(withLosses),
        static_cast<unsigned long long>(withQuarantine), static_cast<unsigned long long>(restarted),
        static_cast<unsigned long long>(unverified), static_cast<unsigned long long>(verified));
}
