#include "tests/gpu/bvh_check.h"

#include <algorithm>
#include <bit>

namespace antipode {

namespace {

class Inspector {
public:
    Inspector(const Bvh& bvh, const std::vector<Bounds3f>& triangles, const std::vector<Bounds3f>& spheres)
        : bvh_(bvh), triangleCount_(triangles.size()), boxes_(triangles) {
        boxes_.insert(boxes_.end(), spheres.begin(), spheres.end());
        facts_.timesInLeaf.resize(boxes_.size());
        met_.resize(bvh.nodes.size() / Bvh::texelsPerNode);
    }

    BvhFacts run() {
        if (bvh_.nodes.empty() || bvh_.nodes.size() % Bvh::texelsPerNode) {
            fault("the number of texels is " + std::to_string(bvh_.nodes.size()));
        } else {
            visitNode(0, nullptr, 1, 0);
            if (std::find(met_.begin(), met_.end(), false) != met_.end()) fault("a node is out of reach");
        }
        return facts_;
    }

private:
    void fault(const std::string& what) {
        if (facts_.faults.size() < 10) facts_.faults.push_back(what);
    }

    /// `waiting`: nodes with several children on the way to this one, each of which may wait on the stack.
    void visitNode(uint32_t node, const Bounds3f* outer, uint32_t depth, uint32_t waiting) {
        if (node >= met_.size() || met_[node])
            return fault("node " + std::to_string(node) + " is missing or met twice");
        met_[node] = true;
        facts_.depth = std::max(facts_.depth, depth);
        const auto* texels = &bvh_.nodes[size_t(node) * Bvh::texelsPerNode];
        uint32_t children = 0;
        for (int i = 0; i < 4; ++i) children += std::bit_cast<uint32_t>(texels[6][i]) != Bvh::emptyReference;
        for (int i = 0; i < 4; ++i) {
            const Bounds3f box{{texels[0][i], texels[2][i], texels[4][i]}, {texels[1][i], texels[3][i], texels[5][i]}};
            const auto reference = std::bit_cast<uint32_t>(texels[6][i]);
            if (reference == Bvh::emptyReference) {
                if (!(box.lower == Vec3f(1e30f) && box.upper == Vec3f(1e30f))) fault("an empty slot has a box");
                continue;
            }
            if (outer) requireInside(box, *outer, "a child");
            const uint32_t waitingBelow = waiting + (children > 1 ? 1 : 0);
            facts_.deepestStack = std::max(facts_.deepestStack, waitingBelow);
            if (reference >> 31)
                visitLeaf(reference, box);
            else
                visitNode(reference, &box, depth + 1, waitingBelow);
        }
    }

    void visitLeaf(uint32_t reference, const Bounds3f& box) {
        const uint32_t count = (reference >> 27 & 7) + 1, first = reference & 0x07FFFFFF;
        const bool spheres = reference >> 30 & 1;
        ++facts_.leaves;
        facts_.largestLeaf = std::max(facts_.largestLeaf, count);
        if (first + count > bvh_.primitiveOrder.size()) return fault("a leaf reaches past the order's end");
        for (uint32_t i = first; i < first + count; ++i) {
            const uint32_t primitive = bvh_.primitiveOrder[i];
            if (primitive >= boxes_.size()) return fault("a primitive does not exist");
            if (i > first && primitive <= bvh_.primitiveOrder[i - 1]) fault("a leaf is not in ascending order");
            if ((primitive >= triangleCount_) != spheres) fault("a leaf has the wrong kind");
            requireInside(boxes_[primitive], box, "a primitive");
            ++facts_.timesInLeaf[primitive];
        }
    }

    void requireInside(const Bounds3f& inner, const Bounds3f& outer, const std::string& what) {
        for (int axis = 0; axis < 3; ++axis)
            if (!(outer.lower[axis] <= inner.lower[axis] && inner.upper[axis] <= outer.upper[axis]))
                return fault(what + " sticks out of its box");
    }

    const Bvh& bvh_;
    size_t triangleCount_;
    std::vector<Bounds3f> boxes_;
    BvhFacts facts_;
    std::vector<bool> met_;
};

}  // namespace

BvhFacts inspect(const Bvh& bvh, const std::vector<Bounds3f>& triangles, const std::vector<Bounds3f>& spheres) {
    return Inspector(bvh, triangles, spheres).run();
}

}  // namespace antipode
