// The nodes of a glTF file in world space.
#pragma once

#include <vector>

#include "scene/affine.h"
#include "scene/gltf/pose.h"

namespace antipode::gltf {

struct Nodes {
    std::vector<Affine> toWorld;  ///< of every node, shown or not: joints need not be part of the scene
    std::vector<size_t> shown;    ///< the nodes of the file's scene, parents first, in the file's order
};

/// Reads the file's default scene, its first where it names none, or all nodes where it has none; `poses` stand in for
/// what the file says of nodes. Throws Error(Input).
Nodes readNodes(const Document& document, const std::map<size_t, NodePose>& poses);

/// Scale, then rotation (x, y, z, w; any length but zero, which turns nothing), then translation.
Affine fromParts(const Vec3d& translation, const std::array<double, 4>& rotation, const Vec3d& scale);

}  // namespace antipode::gltf
