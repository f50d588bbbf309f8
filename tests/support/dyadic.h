#pragma once

#include "renderengine/iteration_range.h"

namespace antipode::test {

/// Whether the range is [k·2^L, (k+1)·2^L) for some k and L. Two dyadic ranges nest or are disjoint.
constexpr bool isDyadic(const IterationRange& range) {
    return range.count != 0 && (range.count & (range.count - 1)) == 0 && range.first % range.count == 0;
}

}  // namespace antipode::test
