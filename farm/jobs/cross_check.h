// Which committed blocks are rendered a second time, and what follows from it.
//
// A block is drawn by a hash of (seed, its first iteration). Guaranteed: the draw does not depend on who renders the
// block, when, or what came before, so a node cannot influence it; and a node that renders a block for the first time
// cannot tell from the lease whether it will be checked, unless it knows the seed: the seed has to be random for that,
// and is never sent. Not guaranteed: that a node does not recognise the second rendering as one (it may have seen the
// range go by); and that wrong sums are found where most of the nodes that render a block agree on them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "renderengine/iteration_range.h"

namespace antipode {

class CrossCheck {
public:
    struct Vote {
        uint32_t node;
        std::string sha256;
    };
    struct Check {
        IterationRange range;
        std::string deviceClass;
        std::vector<Vote> votes;  ///< the first one is whose sums are committed; all differ
        bool disputed() const { return votes.size() > 1; }
        bool has(uint32_t node) const;
    };

    CrossCheck(double fraction, uint64_t seed) : fraction_(fraction), seed_(seed) {}

    bool enabled() const { return fraction_ > 0; }
    bool drawn(uint64_t first) const;

    /// A block was committed that is to be rendered by another node of the class. Returns whether it will be: checks
    /// that nobody makes do not pile up without end.
    bool add(const IterationRange& range, const std::string& deviceClass, Vote vote);
    /// The pending check of exactly this range.
    const Check* find(const IterationRange& range) const;

    struct Outcome {
        bool differs = false;         ///< from a vote before it
        std::vector<uint32_t> wrong;  ///< nodes that two equal renderings convict
    };
    /// Another rendering of a pending check's range. As soon as two nodes agree the check is over.
    Outcome vote(const IterationRange& range, Vote vote);

    /// The node is not believed any more: its votes go, and the checks of what it has committed.
    void withdraw(uint32_t node);
    void drop(const IterationRange& range) { pending_.erase(range.first); }

    /// By first iteration: committed ranges are disjoint.
    const std::map<uint64_t, Check>& pending() const { return pending_; }

private:
    const double fraction_;
    const uint64_t seed_;
    std::map<uint64_t, Check> pending_;
};

}  // namespace antipode
