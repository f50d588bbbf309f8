#include "farm/jobs/merge.h"

#include "proto/wire/job_messages.h"
#include "renderengine/error_classes.h"

namespace antipode {
namespace {

/// Adds to sums that may still be empty.
void addTo(FilmSums& total, const FilmSums& part) {
    if (total.values.empty())
        total = part;
    else
        total.merge(part);
}

/// The reverse of merge(). Returns false where a sum overflows; `total` is then of no more use.
bool subtract(FilmSums& total, const FilmSums& part) {
    for (size_t i = 0; i < total.values.size(); ++i)
        if (__builtin_sub_overflow(total.values[i], part.values[i], &total.values[i])) return false;
    total.iterations -= part.iterations;
    for (size_t k = 0; k < total.residueIterations.size(); ++k) total.residueIterations[k] -= part.residueIterations[k];
    total.events -= part.events;
    if (total.iterations == 0) total = {};
    return true;
}

}  // namespace

Merge::Merge(bool withdrawable, bool inClasses, std::optional<Checkpoint> start)
    : withdrawable_(withdrawable), errorClasses_(inClasses) {
    if (!start) return;
    if (!start->sums.values.empty() && inClasses != hasErrorClasses(start->sums.layout))
        start->sums = inClasses ? inErrorClasses(start->sums, 0) : outOfErrorClasses(start->sums);
    start_.deviceClasses = {start->deviceClasses.begin(), start->deviceClasses.end()};
    start_.statistics = start->statistics;
    start_.iterations = committed_ = start->committed;
    if (withdrawable_) start_.sums = start->sums;
    total_ = std::move(start->sums);
}

Merge::Contribution& Merge::contributionOf(uint32_t node) { return withdrawable_ ? nodes_[node] : start_; }

void Merge::add(uint32_t node, const std::string& deviceClass, const BlockResult& result) {
    Contribution& contribution = contributionOf(node);
    if (withdrawable_) {
        const FilmSums sums = errorClasses_ ? inErrorClasses(result.sums, result.range.first) : result.sums;
        addTo(total_, sums);
        try {
            addTo(contribution.sums, sums);
        } catch (...) {
            subtract(total_, sums);  // exact: it was just added
            throw;
        }
    } else if (!errorClasses_) {
        addTo(total_, result.sums);
    } else if (total_.values.empty()) {
        total_ = inErrorClasses(result.sums, result.range.first);
    } else {
        total_.merge(result.sums, errorClass(result.range.first));
    }
    committed_.add(result.range);
    contribution.iterations.add(result.range);
    contribution.deviceClasses.insert(deviceClass);
    wire::accumulate(contribution.statistics, result.statistics);
}

IterationSet Merge::withdraw(uint32_t node) {
    const auto found = nodes_.find(node);
    if (found == nodes_.end() || found->second.iterations.empty()) return {};
    const IterationSet before = committed_;
    if (subtract(total_, found->second.sums)) {
        for (const IterationRange& range : found->second.iterations.ranges()) committed_.remove(range);
        nodes_.erase(found);
    } else {
        withdrawAll();
    }
    IterationSet withdrawn = before;
    for (const IterationRange& range : committed_.ranges()) withdrawn.remove(range);
    return withdrawn;
}

void Merge::withdrawAll() {
    nodes_.clear();
    total_ = start_.sums;
    committed_ = start_.iterations;
}

EngineStatistics Merge::statistics() const {
    EngineStatistics total = start_.statistics;
    for (const auto& [node, contribution] : nodes_) wire::accumulate(total, contribution.statistics);
    return total;
}

std::set<std::string> Merge::deviceClasses() const {
    std::set<std::string> all = start_.deviceClasses;
    for (const auto& [node, contribution] : nodes_)
        all.insert(contribution.deviceClasses.begin(), contribution.deviceClasses.end());
    return all;
}

}  // namespace antipode
