// What results are added to.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "farm/jobs/iteration_set.h"
#include "renderengine/block_worker.h"

namespace antipode {

/// Which iterations are committed, and their sums: of one image (Merge), or of blocks that are asked for (Parts).
class Ledger {
public:
    virtual ~Ledger() = default;

    /// Whether a result of these iterations can be added: none is committed, and all go to the same sums.
    virtual bool takes(const IterationRange& range) const = 0;
    /// Adds a result that it takes(). Throws Error(Usage) where sizes or scales differ or a sum would overflow, and
    /// then changes nothing.
    virtual void add(uint32_t node, const std::string& deviceClass, const BlockResult& result) = 0;
    /// Takes out what the node has contributed and returns its iterations; others, too, where what is left would not
    /// fit in 64 bits.
    virtual IterationSet withdraw(uint32_t node) = 0;

    /// Iterations that nobody has to render any more.
    virtual const IterationSet& committed() const = 0;
    /// Sums of some of what is committed, to compare others with; empty where there are none.
    virtual const FilmSums& sums() const = 0;
    /// Where the sums that the iteration goes to end.
    virtual uint64_t endOfSums(uint64_t iteration) const = 0;
};

}  // namespace antipode
