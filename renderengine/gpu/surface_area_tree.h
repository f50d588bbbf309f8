// A tree over boxes, as Embree builds it.
#pragma once

#include "gpu/bvh.h"

#include <embree3/rtcore.h>

namespace antipode {

/// A tree of nodes with at most four children over at most four boxes per leaf.
class SurfaceAreaTree {
public:
    static constexpr uint32_t width = 4;

    /// Either an inner node with `childCount` children or a leaf with `itemCount` boxes; one of the two counts is 0.
    struct Node {
        uint32_t childCount = 0, itemCount = 0;
        std::array<const Node*, width> children{};
        std::array<uint32_t, width> items{};  ///< indices into `boxes`, in no particular order
    };

    /// `boxes` is not empty. Where no two boxes have the same centre, the tree depends on the boxes alone. Throws
    /// Error(Device) where memory runs out.
    SurfaceAreaTree(std::span<const Bounds3f> boxes, uint32_t threads);
    ~SurfaceAreaTree();
    SurfaceAreaTree(const SurfaceAreaTree&) = delete;
    SurfaceAreaTree& operator=(const SurfaceAreaTree&) = delete;

    const Node& root() const { return *root_; }

private:
    RTCDevice device_ = nullptr;
    RTCBVH memory_ = nullptr;  ///< holds the nodes
    const Node* root_ = nullptr;
};

}  // namespace antipode
