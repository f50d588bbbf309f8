// Walks a hierarchy on the host.
#pragma once

#include "gpu/bvh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace antipode {

/// What a walk over all nodes of a hierarchy found.
struct BvhFacts {
    std::vector<std::string> faults;    ///< what breaks the layout or the bounds; stops after a few
    std::vector<uint32_t> timesInLeaf;  ///< per primitive
    uint32_t leaves = 0, largestLeaf = 0, depth = 0;
    uint32_t deepestStack = 0;  ///< most nodes with several children on one way down
};

/// Checks every node of a hierarchy over `triangles` and `spheres`: children's boxes hold their children's or their
/// primitives, leaves hold one kind in ascending order, empty slots look as they should, no node is met twice.
BvhFacts inspect(const Bvh& bvh, const std::vector<Bounds3f>& triangles, const std::vector<Bounds3f>& spheres);

}  // namespace antipode
