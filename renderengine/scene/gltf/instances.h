// Copies of a node's mesh (EXT_mesh_gpu_instancing).
#pragma once

#include <vector>

#include "scene/affine.h"
#include "scene/gltf/document.h"

namespace antipode::gltf {

/// Where the node's mesh stands in the node's space: once and for all at the identity where it has no instances. Throws
/// Error(Input).
std::vector<Affine> instancesOf(const Document& document, const json& node);

}  // namespace antipode::gltf
