// What a relay is asked for: blocks of iterations, each with sums of its own.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "farm/jobs/ledger.h"
#include "farm/jobs/merge.h"

namespace antipode {

/// Whatever nobody asks for counts as committed: leases then know only of what is to be rendered.
class Parts final : public Ledger {
public:
    /// Where contributions may have to be withdrawn the sums of each node are kept, see Merge.
    explicit Parts(bool withdrawable);

    /// Asks for a block none of whose iterations is asked for, of fewer than 2^40.
    void ask(const IterationRange& block);
    /// Asks for nothing of the block at or beyond `end` any more, which is not below committedEnd().
    void cut(uint64_t first, uint64_t end);
    /// Ends a block that is whole and gives its sums, not hashed; nothing where it was cut before its first iteration.
    std::optional<BlockResult> take(uint64_t first);

    /// What is asked for of the block that begins there; nothing where none does.
    std::optional<IterationRange> find(uint64_t first) const;
    /// First iterations of the blocks of which all is committed, up to where they were cut.
    std::vector<uint64_t> whole() const;
    /// One past the last iteration of the block that is committed; its first where none is.
    uint64_t committedEnd(uint64_t first) const;
    uint64_t committedCount(uint64_t first) const;

    bool takes(const IterationRange& range) const override;
    void add(uint32_t node, const std::string& deviceClass, const BlockResult& result) override;
    IterationSet withdraw(uint32_t node) override;
    const IterationSet& committed() const override { return committed_; }
    const FilmSums& sums() const override;
    uint64_t endOfSums(uint64_t iteration) const override;

private:
    struct Part {
        IterationRange range;
        Merge merge;
    };
    /// The block that holds the iteration.
    const Part* at(uint64_t iteration) const;

    const bool withdrawable_;
    std::map<uint64_t, Part> parts_;  ///< by first iteration, disjoint
    IterationSet committed_;
    FilmSums none_;
};

}  // namespace antipode
