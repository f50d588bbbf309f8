#include "farm/jobs/coordinator.h"

#include <algorithm>
#include <set>

#include "farm/jobs/cross_check.h"
#include "farm/jobs/leases.h"
#include "farm/jobs/merge.h"
#include "farm/jobs/messages.h"
#include "farm/jobs/parts.h"
#include "farm/jobs/scheduler.h"
#include "farm/jobs/strangeness.h"
#include "renderengine/error.h"
#include "renderengine/error_classes.h"

namespace antipode {
namespace {

/// Nodes of one class are alike; a node that is so much faster than another does not render, or not what was asked for.
constexpr double strangeSpeedRatio = 4;
/// In a row: once can happen to the best, and what is not of the job the first time will not be the third time.
constexpr uint32_t mostRefusals = 3;
/// Scales are chosen so that a million iterations stay below it (filmScaleExponent()): of two such sums none overflows.
constexpr int64_t greatestSum = int64_t(1) << 62;

std::string describe(const IterationRange& range) {
    return range.count == 1 ? "iteration " + std::to_string(range.end())
                            : "iterations " + std::to_string(range.first + 1) + " to " + std::to_string(range.end());
}

bool isPrefix(const IterationRange& range, const IterationRange& of) {
    return range.first == of.first && range.count >= 1 && range.count <= of.count;
}

/// Iterations per second of one device of the node's.
double ratePerWidth(const NodeEntry& node) { return node.speed.rate() / std::max(node.description.width, 1u); }

NodeStatus::State stateOf(const NodeEntry& node) {
    if (node.quarantined) return NodeStatus::State::Quarantined;
    if (!node.port) return NodeStatus::State::Gone;
    if (node.stalled) return NodeStatus::State::Stalled;
    return node.queue.empty() ? NodeStatus::State::Idle : NodeStatus::State::Rendering;
}

}  // namespace

struct Coordinator::Impl {
    Impl(JobDefinition definition, const CoordinatorOptions& given, std::optional<Checkpoint> start)
        : job(std::move(definition)),
          layout(job.film.layers.empty() ? filmLayout(job.settings) : job.film),
          options(given),
          merge(given.verifyFraction > 0, given.errorClasses, std::move(start)),
          parts(given.verifyFraction > 0),
          ledger(given.inParts ? static_cast<Ledger&>(parts) : merge),
          checks(given.verifyFraction, given.verifySeed),
          leases(options, ledger.committed(), messages,
                 given.inParts ? endOfTime : given.iterations.value_or(endOfTime)),
          scheduler(options, leases, ledger, checks),
          endIsFixed(given.inParts || given.iterations.has_value()),
          deviceClasses(merge.deviceClasses()) {}

    const std::string& nameOf(NodeId node) const { return leases.nodes().at(node).description.name; }
    bool allCommitted() const { return endIsFixed && ledger.committed().prefix() >= leases.end(); }

    // ---- Results

    Verdict judge(const LeaseEntry& entry, const IterationRange& range) const;
    /// Why the sums cannot be of this job, if they cannot.
    std::string misfit(const BlockResult& result) const;
    Verdict refuse(LeaseEntry& entry, const std::string& why, double now);
    /// The result is right, but its sums do not fit: rendered again they would not either, so that the job ends.
    Verdict fail(LeaseEntry& entry, const IterationRange& range, const std::string& why, double now);
    /// What is left to do with a result that is not to be committed: its hash may tell something. Settles the lease.
    void compareOnly(LeaseEntry& entry, const IterationRange& range, const std::string& sha256, double now);
    void commit(LeaseEntry& entry, const BlockResult& result, double now);

    // ---- Verification

    void enqueueCheck(const LeaseEntry& entry, const BlockResult& result);
    /// What is strange about a result that is about to be committed; empty where nothing is.
    std::string suspicion(NodeId node, const BlockResult& result) const;
    void castVote(const IterationRange& range, NodeId node, const std::string& sha256);
    void sayDifferent(const IterationRange& range, NodeId a, NodeId b);
    /// `why` goes on after "is not used any more: ".
    void quarantine(NodeId node, const std::string& why);
    void attendToChecks(double now);

    // ---- The end of an unlimited job

    void fixEnd(double now);

    const JobDefinition job;
    const FilmLayout layout;  ///< of its films, at whatever scale
    const CoordinatorOptions options;
    Messages messages;
    Merge merge;     ///< the image
    Parts parts;     ///< or the blocks that are asked for
    Ledger& ledger;  ///< one of the two
    CrossCheck checks;
    Leases leases;
    Scheduler scheduler;
    bool endIsFixed, stopped = false;
    uint64_t hold = endOfTime;
    std::string failure;
    std::optional<double> endingSince;
    std::optional<double> uncheckableSince;  ///< since when nothing is left but checks that no node can make
    std::set<std::string> deviceClasses;
    std::string onlyClass;  ///< of all that renders blocks that are asked for
    uint64_t hashMismatches = 0;
};

Verdict Coordinator::Impl::judge(const LeaseEntry& entry, const IterationRange& range) const {
    if (!isPrefix(range, entry.lease.range)) return Verdict::Rejected;
    if (entry.check || range.end() > leases.end() || !ledger.takes(range)) return Verdict::NotNeeded;
    return Verdict::Committed;
}

std::string Coordinator::Impl::misfit(const BlockResult& result) const {
    const FilmSums& sums = result.sums;
    if (!sums.layout.sameLayers(layout) || sums.values.size() != layout.values() ||
        sums.iterations != result.range.count || sums.residueIterations != layout.residueCounts(result.range))
        return "its layers or its size are not those of the job";
    const FilmLayout& ours = options.errorClasses ? withErrorClasses(sums.layout) : sums.layout;
    if (job.film.layers.empty() ? !ledger.sums().values.empty() && ours != ledger.sums().layout : sums.layout != layout)
        return "its scale is not that of the job: install the same build on both";
    if (std::ranges::any_of(sums.values, [](int64_t sum) { return sum > greatestSum || sum < -greatestSum; }))
        return "its sums are greater than those of any iterations";
    return "";
}

Verdict Coordinator::Impl::refuse(LeaseEntry& entry, const std::string& why, double now) {
    const NodeId id = entry.node;
    messages.sayOnce("refused " + nameOf(id), "A result of node " + nameOf(id) + " was refused: " + why + ".");
    leases.settle(entry, 0, now);
    NodeEntry& node = leases.nodes().at(id);
    if (!node.quarantined && ++node.refusals == mostRefusals)
        quarantine(id,
                   std::to_string(mostRefusals) + " of its results in a row were refused, the last one because " + why);
    return Verdict::Rejected;
}

Verdict Coordinator::Impl::fail(LeaseEntry& entry, const IterationRange& range, const std::string& why, double now) {
    if (failure.empty())
        failure = "The image cannot take in " + describe(range) + " of node " + nameOf(entry.node) + ": " + why;
    stopped = true;
    leases.settle(entry, 0, now);
    leases.truncateAll();
    return Verdict::Rejected;
}

void Coordinator::Impl::compareOnly(LeaseEntry& entry, const IterationRange& range, const std::string& sha256,
                                    double now) {
    const NodeId node = entry.node;
    const bool check = entry.check, whole = range == entry.lease.range;
    const std::optional<LeaseEntry::Winner> winner = entry.winner;
    const std::string deviceClass = leases.nodes().at(node).description.deviceClass;
    leases.settle(entry, 0, now);
    if (!whole) return;
    if (check) {
        castVote(range, node, sha256);
    } else if (winner && winner->node != node && winner->deviceClass == deviceClass) {
        // Two renderings of one block by equal devices: a check for free.
        if (checks.enabled()) {
            if (sha256 != winner->sha256 && !checks.find(range))
                checks.add(range, deviceClass, {winner->node, winner->sha256});
            castVote(range, node, sha256);
        } else if (sha256 != winner->sha256) {
            sayDifferent(range, winner->node, node);
        }
    }
}

void Coordinator::Impl::commit(LeaseEntry& entry, const BlockResult& result, double now) {
    const std::string& deviceClass = leases.nodes().at(entry.node).description.deviceClass;
    leases.committed(entry, result);
    leases.nodes().at(entry.node).refusals = 0;
    if (deviceClasses.insert(deviceClass).second && deviceClasses.size() > 1)
        messages.sayOnce("classes",
                         "Devices of different classes ('" + *deviceClasses.begin() + "', '" + *deviceClasses.rbegin() +
                             "') render this image; it then equals that of another farm only statistically.");
    enqueueCheck(entry, result);
    leases.settle(entry, result.range.count, now);
}

void Coordinator::Impl::enqueueCheck(const LeaseEntry& entry, const BlockResult& result) {
    const NodeEntry& node = leases.nodes().at(entry.node);
    const std::string strange = suspicion(entry.node, result);
    if (!checks.enabled()) {
        if (!strange.empty())
            messages.sayOnce("strange " + nameOf(entry.node), "What node " + nameOf(entry.node) + " rendered in " +
                                                                  describe(result.range) + " " + strange +
                                                                  ": --verify finds out whether that is right.");
        return;
    }
    // Nothing is known of a node yet that has contributed nothing. Without a second node now one may still come.
    // What is strange is rendered a second time, whatever was drawn.
    if (node.results > 0 && strange.empty() && !checks.drawn(result.range.first)) return;
    if (!checks.add(result.range, node.description.deviceClass, {entry.node, result.sha256}))
        messages.sayOnce("unverified",
                         "Some blocks are not verified: more of them wait for a second rendering than are kept.");
}

std::string Coordinator::Impl::suspicion(NodeId id, const BlockResult& result) const {
    if (isBlack(result.sums) && !isBlack(ledger.sums())) return "is black";
    if (!checks.enabled()) return "";
    if (std::string strange = strangeness(result.sums, ledger.sums()); !strange.empty()) return strange;
    const NodeEntry& node = leases.nodes().at(id);
    for (const auto& [other, entry] : leases.nodes())
        if (other != id && entry.description.deviceClass == node.description.deviceClass && entry.speed.known() &&
            node.speed.known() && ratePerWidth(node) > strangeSpeedRatio * ratePerWidth(entry))
            return "came faster than devices of its class render";
    return "";
}

void Coordinator::Impl::castVote(const IterationRange& range, NodeId node, const std::string& sha256) {
    const CrossCheck::Check* check = checks.find(range);
    if (!check) return;
    const NodeId committer = check->votes.front().node;
    const CrossCheck::Outcome outcome = checks.vote(range, {node, sha256});
    if (outcome.differs) sayDifferent(range, committer, node);
    for (const NodeId wrong : outcome.wrong)
        quarantine(wrong, "two other nodes agree that it rendered " + describe(range) +
                              " wrongly; all that it contributed is rendered again");
}

void Coordinator::Impl::sayDifferent(const IterationRange& range, NodeId a, NodeId b) {
    ++hashMismatches;
    messages.say("Nodes " + nameOf(a) + " and " + nameOf(b) + " disagree on " + describe(range) +
                 (checks.enabled() ? "." : ": one of them renders wrongly; --verify finds out which one."));
}

void Coordinator::Impl::quarantine(NodeId node, const std::string& why) {
    messages.say("Node " + nameOf(node) + " is not used any more: " + why + ".");
    leases.nodes().at(node).quarantine = why;
    checks.withdraw(node);
    leases.quarantine(node);
    const IterationSet withdrawn = ledger.withdraw(node);
    leases.uncommitted(withdrawn);
    NodeEntry& entry = leases.nodes().at(node);
    if (!withdrawn.empty()) {
        entry.lost += entry.committed;
        entry.committed = entry.results = 0;
    }
    std::vector<IterationRange> moot;
    for (const auto& [first, check] : checks.pending())
        if (!ledger.committed().contains(check.range)) moot.push_back(check.range);
    for (const IterationRange& each : moot) checks.drop(each);
    for (auto& [id, lease] : leases.all())
        if (lease.check && !checks.find(lease.lease.range)) leases.truncate(lease);
}

/// No job ends with checks open: where all the rest is done it waits for a node that can make them, but not for ever.
void Coordinator::Impl::attendToChecks(double now) {
    std::vector<CrossCheck::Check> impossible;
    for (const auto& [first, check] : checks.pending())
        if ((check.disputed() || allCommitted()) && !scheduler.canBeChecked(check)) impossible.push_back(check);
    for (const CrossCheck::Check& check : impossible)
        messages.sayOnce(
            check.disputed() ? "dispute " + std::to_string(check.range.first) : "unverified " + check.deviceClass,
            "The job waits for a further node of class '" + check.deviceClass +
                (check.disputed() ? "' that decides who rendered " + describe(check.range) + " wrongly."
                                  : "' to verify what was rendered."));
    if (impossible.empty() || !allCommitted() || impossible.size() < checks.pending().size()) {
        uncheckableSince.reset();
        return;
    }
    if (!uncheckableSince) uncheckableSince = now;
    if (now - *uncheckableSince < options.verifyPatienceSeconds) return;
    const bool disputed = std::ranges::any_of(impossible, &CrossCheck::Check::disputed);
    failure = "The image is not verified: no further node of class '" + impossible.front().deviceClass +
              "' came that " +
              (disputed ? "decides which of two nodes renders wrongly" : "renders blocks a second time") +
              ". Add one, or render without --verify.";
    stopped = true;
}

/// The image ends where the last committed iteration does, once all that lies above has come or is given up.
void Coordinator::Impl::fixEnd(double now) {
    const uint64_t committed = merge.committed().end();
    const bool patient = now - *endingSince < 2 * options.leastPatienceSeconds;
    if (patient && std::ranges::any_of(leases.all(), [&](const auto& lease) {
            return lease.second.claims && lease.second.lease.range.end() > committed;
        }))
        return;
    leases.setEnd(std::max<uint64_t>(committed, 1));
    endIsFixed = true;
}

Coordinator::Coordinator(JobDefinition job, CoordinatorOptions options, std::optional<Checkpoint> start) {
    if (start) {
        requireSameJob(*start, job);
        if (options.iterations && start->committed.end() > *options.iterations)
            throw Error(ErrorCode::Usage, "The checkpoint holds " + std::to_string(start->committed.end()) +
                                              " iterations already, more than the " +
                                              std::to_string(*options.iterations) + " that are asked for.");
    }
    impl_ = std::make_unique<Impl>(std::move(job), options, std::move(start));
}

Coordinator::~Coordinator() = default;

NodeId Coordinator::addNode(const NodeDescription& description, NodePort& port, double) {
    Impl& self = *impl_;
    const NodeId node = self.leases.join(description, port);
    if (!self.options.inParts) return node;
    if (self.onlyClass.empty()) self.onlyClass = description.deviceClass;
    if (description.deviceClass == self.onlyClass) return node;
    self.leases.retire(node);
    self.messages.sayOnce("class " + description.name,
                          "Node " + description.name + " renders as '" + description.deviceClass +
                              "', the others as '" + self.onlyClass + "': it is not used, give it another relay.");
    return node;
}

void Coordinator::removeNode(NodeId node, double) { impl_->leases.leave(node); }

void Coordinator::retireNode(NodeId node, double) { impl_->leases.retire(node); }

void Coordinator::setWidth(NodeId node, uint32_t width, double) {
    impl_->leases.nodes().at(node).description.width = width;
}

void Coordinator::progress(NodeId node, LeaseId lease, uint64_t done, double now) {
    if (LeaseEntry* entry = impl_->leases.find(node, lease)) impl_->leases.progress(*entry, done, now);
}

void Coordinator::returned(NodeId node, LeaseId lease, double now) {
    LeaseEntry* entry = impl_->leases.find(node, lease);
    if (!entry) return;
    impl_->leases.wake(node);
    impl_->leases.settle(*entry, 0, now);
}

bool Coordinator::wanted(NodeId node, LeaseId lease, IterationRange range, const std::string& sha256, double now) {
    Impl& self = *impl_;
    LeaseEntry* entry = self.leases.find(node, lease);
    if (!entry) return false;
    const Verdict verdict = self.judge(*entry, range);
    if (verdict == Verdict::Rejected || self.leases.nodes().at(node).quarantined) {
        self.refuse(*entry, "it is not of the block that was asked for, or the node is in quarantine", now);
        return false;
    }
    self.leases.offered(*entry, range.count, now);
    if (verdict == Verdict::Committed) return true;
    self.compareOnly(*entry, range, sha256, now);
    return false;
}

Verdict Coordinator::deliver(NodeId node, LeaseId lease, const BlockResult& result, double now) {
    Impl& self = *impl_;
    LeaseEntry* entry = self.leases.find(node, lease);
    if (!entry) {
        // A lease that was settled before, whose verdict never arrived; or one that never was.
        const bool plausible = result.range.first < endOfTime && result.range.count < endOfTime;
        return plausible && self.ledger.committed().intersects(result.range) ? Verdict::NotNeeded : Verdict::Rejected;
    }
    if (self.leases.nodes().at(node).quarantined) return self.refuse(*entry, "the node is in quarantine", now);
    const Verdict verdict = self.judge(*entry, result.range);
    if (verdict == Verdict::Rejected) return self.refuse(*entry, "it is not of the block that was asked for", now);
    self.leases.offered(*entry, result.range.count, now);
    if (verdict == Verdict::NotNeeded) {
        self.compareOnly(*entry, result.range, result.sha256, now);
        return verdict;
    }
    if (const std::string misfit = self.misfit(result); !misfit.empty()) return self.refuse(*entry, misfit, now);
    if (const uint64_t left = result.sums.events.total(EventKind::SumOverflow); left > 0)
        return self.fail(*entry, result.range,
                         "sums of pixels left 64 bits " + std::to_string(left) +
                             " times; some light is too close to what it shines on, or to the camera: move it, or "
                             "give it a surface instead of a point.",
                         now);
    try {
        self.ledger.add(node, self.leases.nodes().at(node).description.deviceClass, result);
    } catch (const Error& error) {
        return self.fail(*entry, result.range, error.what(), now);
    }
    self.commit(*entry, result, now);
    return Verdict::Committed;
}

void Coordinator::reject(NodeId node, LeaseId lease, double now) {
    if (LeaseEntry* entry = impl_->leases.find(node, lease)) impl_->refuse(*entry, "it did not arrive whole", now);
}

void Coordinator::tick(double now) {
    Impl& self = *impl_;
    self.leases.expire(now);
    if (self.endingSince && !self.endIsFixed) self.fixEnd(now);
    if (self.stopped) return;
    self.attendToChecks(now);
    if (self.stopped) return;
    const uint64_t limit = self.endIsFixed || !self.endingSince
                               ? self.leases.end()
                               : std::min(self.leases.end(), self.merge.committed().end());
    self.scheduler.handOut(std::min(limit, self.hold), now);
}

void Coordinator::finishEarly(double now) {
    if (impl_->endingSince || impl_->allCommitted()) return;
    impl_->endingSince = now;
    impl_->endIsFixed = false;
    // Checks are needed whole.
    for (auto& [id, entry] : impl_->leases.all())
        if (!entry.check) impl_->leases.truncate(entry);
}

void Coordinator::holdAt(uint64_t end) { impl_->hold = end; }

void Coordinator::stop(double) {
    impl_->stopped = true;
    impl_->leases.truncateAll();
}

void Coordinator::ask(IterationRange block) {
    impl_->parts.ask(block);
    IterationSet wanted;
    wanted.add(block);
    impl_->leases.uncommitted(wanted);
}

void Coordinator::cut(uint64_t first, double) {
    Impl& self = *impl_;
    const IterationRange block = *self.parts.find(first);
    const uint64_t end = std::max(self.parts.committedEnd(first), self.leases.firstNotBegun(block));
    if (end >= block.end()) return;
    self.parts.cut(first, end);
    self.leases.dropped({end, block.end() - end});
}

uint64_t Coordinator::rendered(uint64_t first) const {
    return impl_->parts.committedCount(first) + impl_->leases.inHand(*impl_->parts.find(first));
}

std::vector<uint64_t> Coordinator::finishedParts() const {
    std::vector<uint64_t> finished = impl_->parts.whole();
    std::erase_if(finished, [&](uint64_t first) {
        const IterationRange block = *impl_->parts.find(first);
        return std::ranges::any_of(impl_->checks.pending(),
                                   [&](const auto& check) { return block.contains(check.second.range); });
    });
    return finished;
}

std::optional<BlockResult> Coordinator::takePart(uint64_t first, double) { return impl_->parts.take(first); }

uint32_t Coordinator::width() const {
    uint64_t width = 0;
    for (const auto& [id, node] : impl_->leases.nodes())
        if (node.usable()) width += node.description.width;
    return uint32_t(std::min<uint64_t>(width, UINT32_MAX));
}

const std::string& Coordinator::renderingClass() const { return impl_->onlyClass; }

bool Coordinator::complete() const { return impl_->allCommitted() && impl_->checks.pending().empty(); }

uint32_t Coordinator::outstanding() const {
    return uint32_t(
        std::ranges::count_if(impl_->leases.all(), [](const auto& lease) { return !lease.second.expired; }));
}

const FilmSums& Coordinator::sums() const { return impl_->merge.sums(); }

const IterationSet& Coordinator::committed() const { return impl_->merge.committed(); }

EngineStatistics Coordinator::statistics() const { return impl_->merge.statistics(); }

Checkpoint Coordinator::checkpoint(double wallSeconds) const {
    const std::set<std::string> classes = impl_->merge.deviceClasses();
    return {impl_->job, {classes.begin(), classes.end()}, committed(), sums(), statistics(), wallSeconds};
}

const std::string& Coordinator::failure() const { return impl_->failure; }

uint64_t Coordinator::hashMismatches() const { return impl_->hashMismatches; }

std::vector<NodeStatus> Coordinator::nodes() const {
    std::vector<NodeStatus> result;
    for (const auto& [id, node] : impl_->leases.nodes()) {
        uint64_t inHand = 0;
        for (const LeaseId lease : node.queue) inHand += impl_->leases.all().at(lease).done;
        result.push_back({id, node.description, stateOf(node), node.speed.rate(), uint32_t(node.queue.size()), inHand,
                          node.committed, node.results, node.lost, node.quarantine});
    }
    return result;
}

std::vector<std::string> Coordinator::takeMessages() { return impl_->messages.take(); }

}  // namespace antipode
