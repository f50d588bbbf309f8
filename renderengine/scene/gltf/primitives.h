// Primitives: attributes and indices of a mesh's part, whatever their layout, as triangles.
#pragma once

#include <string>

#include "renderengine/scene.h"
#include "scene/gltf/document.h"
#include "scene/mesh_cleanup.h"

namespace antipode::gltf {

/// The triangles of a primitive in the mesh's own space, not cleaned; none where it holds points or lines, which count
/// as dropped. Triangles that a strip repeats a vertex in, as those that join strips do, are left out. Throws
/// Error(Input) that names the mesh where attributes and indices do not agree.
Mesh readPrimitive(const Document& document, const json& primitive, const std::string& meshName, MeshLosses& losses);

}  // namespace antipode::gltf
