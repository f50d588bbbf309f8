// Four-wide bounding volume hierarchy in the layout that the kernels traverse.
#pragma once

#include "numerics/bounds.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace antipode {

/// Node 0 is the root. A node is seven texels: lower x of its four children, upper x, lower y, upper y, lower z, upper
/// z, and the bits of four uint32 child references, which look like odd floats: read them through an unsigned view. A
/// reference to a node is its index. One to a leaf has bit 31 set, bit 30 set for spheres and clear for triangles, the
/// number of primitives less one in bits 27 to 29, and the place of the first in `primitiveOrder` in bits 0 to 26.
/// An empty child has the reference 0xFFFFFFFF and the box [1e30, 1e30]³, which no segment that ends before reaches; an
/// inverted box would pass a min/max slab test.
struct Bvh {
    static constexpr uint32_t texelsPerNode = 7;
    static constexpr uint32_t emptyReference = 0xFFFFFFFF;
    static constexpr float emptyCoordinate = 1e30f;
    static constexpr uint32_t maxPrimitives = 1u << 27;
    static constexpr uint32_t maxLeafSize = 8;

    std::vector<std::array<float, 4>> nodes;  ///< texelsPerNode each
    std::vector<uint32_t> primitiveOrder;     ///< triangles are 0 … T-1, spheres T …; ascending within a leaf
    /// Enough entries for the stack of a traversal that descends into one child and keeps the others as one entry: the
    /// most nodes with several children on a way down from the root.
    uint32_t stackDepth = 0;
    double buildSeconds = 0.0;
};

/// Builds the hierarchy over the boxes of triangles and spheres (either may be empty) by surface area (Embree's binned
/// builder). The result depends on the boxes alone, not on the number of threads or their timing. `threads` = 0 takes
/// all. Throws Error(Input) where a box is inverted, not finite or reaches beyond ±1e18, or there are more than
/// `maxPrimitives`; Error(Device) where memory runs out.
Bvh buildBvh(std::span<const Bounds3f> triangles, std::span<const Bounds3f> spheres, uint32_t threads = 0);

}  // namespace antipode
