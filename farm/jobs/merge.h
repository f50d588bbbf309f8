// What is in the image: sums, statistics and which iterations they are of.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "farm/jobs/block_pool.h"
#include "farm/jobs/checkpoint.h"
#include "farm/jobs/ledger.h"
#include "renderengine/block_worker.h"

namespace antipode {

/// Where contributions may have to be withdrawn it keeps the sums of each node beside the total: the memory of a film
/// (50 MB at 1080p) per node. Otherwise one film is all there is.
class Merge final : public Ledger {
public:
    /// `start` counts as trusted and cannot be withdrawn. With `inClasses` the image is summed in those; what of
    /// `start` is in none counts as one of them.
    Merge(bool withdrawable, bool inClasses, std::optional<Checkpoint> start);

    bool takes(const IterationRange& range) const override { return !committed_.intersects(range); }
    /// See Ledger; all iterations of one run where it sums in classes.
    void add(uint32_t node, const std::string& deviceClass, const BlockResult& result) override;
    /// See Ledger. In the one case where what is left does not fit in 64 bits, though it did together with the node's
    /// sums, everything but the start is taken out.
    IterationSet withdraw(uint32_t node) override;

    const FilmSums& sums() const override { return total_; }
    const IterationSet& committed() const override { return committed_; }
    uint64_t endOfSums(uint64_t) const override { return endOfTime; }
    /// Gives the sums away; the merge is of no more use.
    FilmSums release() { return std::move(total_); }
    EngineStatistics statistics() const;
    std::set<std::string> deviceClasses() const;

private:
    struct Contribution {
        FilmSums sums;  ///< empty unless withdrawable
        IterationSet iterations;
        EngineStatistics statistics;
        std::set<std::string> deviceClasses;
    };
    Contribution& contributionOf(uint32_t node);
    void withdrawAll();

    const bool withdrawable_, errorClasses_;
    Contribution start_;                      ///< without withdrawing: everything
    std::map<uint32_t, Contribution> nodes_;  ///< where withdrawable
    FilmSums total_;
    IterationSet committed_;
};

}  // namespace antipode
