#include "scene/gltf/nodes.h"

#include <array>
#include <cmath>

namespace antipode::gltf {
namespace {

template <size_t n>
std::array<double, n> numbers(const json& parent, const char* key, std::array<double, n> otherwise) {
    if (!parent.contains(key)) return otherwise;
    const json& from = list(parent, key);
    if (from.size() != n) fail(std::string("a node's ") + key + " has not " + std::to_string(n) + " numbers");
    for (size_t i = 0; i < n; ++i) otherwise[i] = from[i].get<double>();
    return otherwise;
}

Vec3d toVec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Affine localTransform(const json& node, const NodePose& pose) {
    if (node.contains("matrix") && !pose.translation && !pose.rotation && !pose.scale) {
        const auto m = numbers<16>(node, "matrix", {});
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    return fromParts(toVec(pose.translation.value_or(numbers<3>(node, "translation", {}))),
                     pose.rotation.value_or(numbers<4>(node, "rotation", {0, 0, 0, 1})),
                     toVec(pose.scale.value_or(numbers<3>(node, "scale", {1, 1, 1}))));
}

/// `hasParent`: whether a node hangs from another.
std::vector<size_t> rootsOf(const json& file, const std::vector<bool>& hasParent) {
    std::vector<size_t> roots;
    if (!list(file, "scenes").empty()) {
        for (const json& root : list(entry(file, "scenes", reference(file, "scene").value_or(0)), "nodes")) {
            roots.push_back(natural(root));
            entry(file, "nodes", roots.back());
        }
    } else {
        for (size_t i = 0; i < hasParent.size(); ++i)
            if (!hasParent[i]) roots.push_back(i);
    }
    return roots;
}

}  // namespace

Affine fromParts(const Vec3d& translation, const std::array<double, 4>& rotation, const Vec3d& scale) {
    auto [x, y, z, w] = rotation;
    const double length2 = x * x + y * y + z * z + w * w;
    const double s = length2 > 0 ? 2 / length2 : 0;
    return {Vec3d(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)) * scale.x,
            Vec3d(s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)) * scale.y,
            Vec3d(s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)) * scale.z, translation};
}

Nodes readNodes(const Document& document, const std::map<size_t, NodePose>& poses) {
    const json& nodes = list(document.json, "nodes");
    const NodePose asInFile;
    Nodes result;
    result.toWorld.resize(nodes.size());
    std::vector<bool> hasParent(nodes.size()), visited(nodes.size());
    for (const json& node : nodes)
        for (const json& child : list(node, "children")) hasParent[natural(child)] = true;

    // Parents first; children that wait are kept in reverse, so that the first comes first.
    const auto visitBelow = [&](size_t root, const auto& visit) {
        std::vector<size_t> waiting{root};
        while (!waiting.empty()) {
            const size_t at = waiting.back();
            waiting.pop_back();
            visit(at);
            const json& children = list(nodes[at], "children");
            for (size_t i = children.size(); i > 0; --i) waiting.push_back(natural(children[i - 1]));
        }
    };
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (hasParent[i]) continue;
        result.toWorld[i] = Affine{};
        visitBelow(i, [&](size_t at) {
            // Until it is visited, a node's entry holds its parent's map.
            const auto posed = poses.find(at);
            const NodePose& pose = posed == poses.end() ? asInFile : posed->second;
            const Affine map = result.toWorld[at] * localTransform(nodes[at], pose);
            result.toWorld[at] = map;
            for (const json& child : list(nodes[at], "children")) result.toWorld[natural(child)] = map;
        });
    }
    for (size_t root : rootsOf(document.json, hasParent)) {
        visitBelow(root, [&](size_t at) {
            if (!visited[at]) result.shown.push_back(at);
            visited[at] = true;
        });
    }
    return result;
}

}  // namespace antipode::gltf
