#include "gpu/bvh.h"

#include "gpu/concentric_groups.h"
#include "gpu/surface_area_tree.h"
#include "renderengine/error.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <string>

namespace antipode {

namespace {

using Node = SurfaceAreaTree::Node;

constexpr uint32_t width = SurfaceAreaTree::width;
constexpr uint32_t leafBit = 1u << 31, sphereBit = 1u << 30, countShift = 27;
// Embree multiplies extents to areas, and sums of these must not overflow.
constexpr float largestCoordinate = 1e18f;

void requireValid(std::span<const Bounds3f> boxes, const char* kind) {
    for (size_t i = 0; i < boxes.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const float lower = boxes[i].lower[axis], upper = boxes[i].upper[axis];
            // Written so that NaN fails.
            if (!(-largestCoordinate <= lower && lower <= upper && upper <= largestCoordinate))
                throw Error(ErrorCode::Input, std::string("The bounds of ") + kind + " " + std::to_string(i) +
                                                  " are not valid: from " + std::to_string(lower) + " to " +
                                                  std::to_string(upper) + " along axis " + "xyz"[axis] + ".");
        }
}

/// Writes the nodes in depth-first order.
class Writer {
public:
    Writer(std::span<const Bounds3f> boxes, uint32_t triangleCount, const ConcentricGroups& groups, Bvh& bvh)
        : boxes_(boxes), triangleCount_(triangleCount), groups_(groups), bvh_(bvh) {}

    void writeRoot(const Node& root) {
        const Child child = write(root);
        // A tree of one leaf gets a node around it, which no node before it has put in place 0.
        if (child.reference & leafBit) writeNode(1, [&](uint32_t) { return child; });
        bvh_.stackDepth = child.stackDepth;
    }

private:
    struct Child {
        uint32_t reference;
        Bounds3f box;
        uint32_t stackDepth;  ///< of a traversal of the child alone
    };
    /// What becomes one leaf: primitives of one kind, at most Bvh::maxLeafSize.
    using Piece = std::span<const uint32_t>;

    Child write(const Node& node) {
        if (node.childCount > 0)
            return writeNode(node.childCount, [&](uint32_t i) { return write(*node.children[i]); });

        std::vector<uint32_t> primitives;
        for (uint32_t i = 0; i < node.itemCount; ++i) {
            const auto group = groups_.group(node.items[i]);
            primitives.insert(primitives.end(), group.begin(), group.end());
        }
        const auto firstSphere = std::stable_partition(primitives.begin(), primitives.end(),
                                                       [&](uint32_t primitive) { return primitive < triangleCount_; });
        const auto triangles = static_cast<size_t>(firstSphere - primitives.begin());
        std::vector<Piece> pieces;
        cut(std::span(primitives).first(triangles), pieces);
        cut(std::span(primitives).subspan(triangles), pieces);
        return writePieces(pieces);
    }

    /// What the tree could not part is cut by count; groups come by rising size, so the small ones stay together.
    static void cut(std::span<uint32_t> primitives, std::vector<Piece>& pieces) {
        for (size_t first = 0; first < primitives.size(); first += Bvh::maxLeafSize)
            pieces.push_back(primitives.subspan(first, std::min<size_t>(Bvh::maxLeafSize, primitives.size() - first)));
    }

    Child writePieces(std::span<const Piece> pieces) {
        if (pieces.size() == 1) return writeLeaf(pieces.front());
        const auto children = static_cast<uint32_t>(std::min<size_t>(width, pieces.size()));
        return writeNode(children, [&](uint32_t i) {
            const size_t begin = pieces.size() * i / children, end = pieces.size() * (i + 1) / children;
            return writePieces(pieces.subspan(begin, end - begin));
        });
    }

    Child writeLeaf(Piece piece) {
        const auto first = static_cast<uint32_t>(bvh_.primitiveOrder.size());
        bvh_.primitiveOrder.insert(bvh_.primitiveOrder.end(), piece.begin(), piece.end());
        std::sort(bvh_.primitiveOrder.begin() + first, bvh_.primitiveOrder.end());
        Bounds3f box = boxes_[piece.front()];
        for (const uint32_t primitive : piece) box.add(boxes_[primitive]);
        const uint32_t kind = piece.front() < triangleCount_ ? 0 : sphereBit;
        return {leafBit | kind | static_cast<uint32_t>(piece.size() - 1) << countShift | first, box, 0};
    }

    /// `child(i)` writes the i-th child and all below it.
    template <class WriteChild>
    Child writeNode(uint32_t childCount, const WriteChild& child) {
        const size_t texel = bvh_.nodes.size();
        const auto index = static_cast<uint32_t>(texel / Bvh::texelsPerNode);
        bvh_.nodes.resize(texel + Bvh::texelsPerNode);
        Child result{index, {}, 0};
        for (uint32_t i = 0; i < width; ++i) {
            const bool isEmpty = i >= childCount;
            const Child slot =
                isEmpty ? Child{Bvh::emptyReference, {Vec3f(Bvh::emptyCoordinate), Vec3f(Bvh::emptyCoordinate)}, 0}
                        : child(i);
            for (int axis = 0; axis < 3; ++axis) {
                bvh_.nodes[texel + 2 * axis][i] = slot.box.lower[axis];
                bvh_.nodes[texel + 2 * axis + 1][i] = slot.box.upper[axis];
            }
            bvh_.nodes[texel + 6][i] = std::bit_cast<float>(slot.reference);
            if (isEmpty) continue;
            result.box.add(slot.box);
            result.stackDepth = std::max(result.stackDepth, slot.stackDepth + (childCount > 1 ? 1u : 0u));
        }
        return result;
    }

    std::span<const Bounds3f> boxes_;
    uint32_t triangleCount_;
    const ConcentricGroups& groups_;
    Bvh& bvh_;
};

void writeEmptyRoot(Bvh& bvh) {
    std::array<float, 4> coordinates, references;
    coordinates.fill(Bvh::emptyCoordinate);
    references.fill(std::bit_cast<float>(Bvh::emptyReference));
    bvh.nodes.assign(Bvh::texelsPerNode, coordinates);
    bvh.nodes.back() = references;
}

}  // namespace

Bvh buildBvh(std::span<const Bounds3f> triangles, std::span<const Bounds3f> spheres, uint32_t threads) {
    const auto start = std::chrono::steady_clock::now();
    const size_t count = triangles.size() + spheres.size();
    if (count > Bvh::maxPrimitives)
        throw Error(ErrorCode::Input, "The scene has " + std::to_string(count) +
                                          " triangles and spheres; the most is " + std::to_string(Bvh::maxPrimitives) +
                                          ".");
    requireValid(triangles, "triangle");
    requireValid(spheres, "sphere");

    Bvh bvh;
    if (count == 0) {
        writeEmptyRoot(bvh);
    } else {
        std::vector<Bounds3f> boxes(triangles.begin(), triangles.end());
        boxes.insert(boxes.end(), spheres.begin(), spheres.end());
        const ConcentricGroups groups = groupConcentric(boxes);
        const SurfaceAreaTree tree(groups.boxes, threads);
        bvh.primitiveOrder.reserve(count);
        Writer(boxes, static_cast<uint32_t>(triangles.size()), groups, bvh).writeRoot(tree.root());
    }
    bvh.buildSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

}  // namespace antipode
