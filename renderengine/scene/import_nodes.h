// The node tree of an imported file, flattened to world space.
#pragma once

#include <assimp/scene.h>

#include <functional>
#include <string>

#include "renderengine/scene.h"
#include "scene/affine.h"

namespace antipode {

/// Calls `visit` for every node, parents first, with the node's map into world space.
void visitNodes(const aiNode& root, const std::function<void(const aiNode&, const Affine&)>& visit);

/// The map into world space of the node of this name; the identity where there is none.
Affine nodeToWorld(const aiScene& file, const std::string& name);

inline Vec3f toVec3f(const aiVector3D& v) { return {v.x, v.y, v.z}; }
inline Vec3d toVec3d(const aiVector3D& v) { return {v.x, v.y, v.z}; }

}  // namespace antipode
