// A coordinator with a clock that the test moves and nodes that do what the test says.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "farm/jobs/coordinator.h"
#include "renderengine/error_classes.h"
#include "tests/support/fake_renderer.h"

namespace antipode::test {

inline JobDefinition smallJob() {
    JobDefinition job;
    job.settings.width = 2;
    job.settings.height = 1;
    job.settings.initialRadius = 0.25;
    job.settings.residueClasses = 3;
    job.settings.layers.add(LayerKind::Albedo);
    job.sceneHash = "scene";
    job.kernelHash = "kernels";
    return job;
}

/// What the results of honest nodes count in so many iterations.
inline EventCounts eventsOf(uint64_t iterations) {
    EventCounts events;
    events.at(EventSource::Merge, EventKind::ZeroPdf) = iterations;
    return events;
}

inline BlockResult resultOf(const JobDefinition& job, const IterationRange& range, bool lie = false) {
    BlockResult result;
    result.range = range;
    result.sums = fakeSums(job.settings, {range});
    result.sums.events = eventsOf(range.count);
    if (lie) ++result.sums.values.front(), ++result.sums.events.at(EventSource::Film, EventKind::Negative);
    result.sha256 = result.sums.sha256();
    result.statistics.rays = range.count;
    return result;
}

/// Remembers what it is asked for.
struct FakePort final : NodePort {
    void grant(const Lease& lease) override { granted.push_back(lease); }
    void truncate(LeaseId lease) override { truncated.push_back(lease); }
    bool isTruncated(LeaseId lease) const { return std::ranges::count(truncated, lease) != 0; }

    std::deque<Lease> granted;
    std::vector<LeaseId> truncated;
};

class JobTest : public testing::Test {
protected:
    void start(const CoordinatorOptions& options, std::optional<Checkpoint> from = {}) {
        coordinator_ = std::make_unique<Coordinator>(job_, options, std::move(from));
    }
    NodeId add(const std::string& name, uint32_t depth = 1, const std::string& deviceClass = "class") {
        const NodeId id = coordinator_->addNode({name, "device", deviceClass, depth}, ports_[name], now_);
        ids_[name] = id;
        return id;
    }
    void tick(double seconds = 0) {
        now_ += seconds;
        coordinator_->tick(now_);
    }
    FakePort& port(const std::string& name) { return ports_.at(name); }
    /// The node's oldest lease that it has not worked on yet.
    Lease take(const std::string& name) {
        FakePort& at = port(name);
        if (at.granted.empty()) {
            ADD_FAILURE() << name << " has no lease";
            return {};
        }
        const Lease lease = at.granted.front();
        at.granted.pop_front();
        return lease;
    }
    bool idle(const std::string& name) { return port(name).granted.empty(); }
    /// Renders the lease at this speed with a report after each iteration; delivers it, or the first `part` of it.
    Verdict render(const std::string& name, const Lease& lease, double secondsPerIteration,
                   std::optional<uint64_t> part = {}, bool lie = false) {
        const uint64_t count = part.value_or(lease.range.count);
        for (uint64_t i = 1; i <= count; ++i) {
            now_ += secondsPerIteration;
            coordinator_->progress(ids_[name], lease.id, i, now_);
        }
        return deliver(name, lease.id, {lease.range.first, count}, lie);
    }
    Verdict deliver(const std::string& name, LeaseId lease, const IterationRange& range, bool lie = false) {
        return coordinator_->deliver(ids_[name], lease, resultOf(job_, range, lie), now_);
    }
    NodeStatus status(const std::string& name) {
        for (const NodeStatus& node : coordinator_->nodes())
            if (node.id == ids_[name]) return node;
        return {};
    }
    /// All messages since the last call.
    std::string messages() {
        std::string all;
        for (const std::string& sentence : coordinator_->takeMessages()) all += sentence + "\n";
        return all;
    }
    /// The sums are those of exactly the committed iterations.
    void expectExact() {
        if (coordinator_->committed().empty()) {
            EXPECT_EQ(coordinator_->sums().iterations, 0u);
            return;
        }
        const FilmSums& sums = coordinator_->sums();
        EXPECT_EQ((hasErrorClasses(sums.layout) ? outOfErrorClasses(sums) : sums).sha256(),
                  fakeSums(job_.settings, coordinator_->committed().ranges()).sha256());
        EXPECT_EQ(coordinator_->sums().events, eventsOf(coordinator_->committed().count()));
        EXPECT_EQ(coordinator_->statistics().rays, coordinator_->committed().count());
    }

    JobDefinition job_ = smallJob();
    std::unique_ptr<Coordinator> coordinator_;
    std::map<std::string, FakePort> ports_;
    std::map<std::string, NodeId> ids_;
    double now_ = 100;
};

}  // namespace antipode::test
