// Primitives: attributes and indices of a mesh's part, whatever their layout, as triangles.
#pragma once

#include <string>

#include "renderengine/scene.h"
#include "scene/gltf/deform.h"
#include "scene/gltf/textures.h"
#include "scene/mesh_cleanup.h"

namespace antipode::gltf {

/// What a primitive's material asks of its vertices.
struct VertexNeeds {
    std::vector<UvStream> uvStreams;  ///< entry k becomes set k; none: set 0 is the file's first
    bool textured = false;            ///< whether something is looked up with them
    bool tangents = false, colors = true;
};

/// Whether the primitive holds triangles, strips or fans.
bool hasTriangles(const json& primitive);

/// The triangles of a primitive in the mesh's own space, not cleaned; none where it holds points or lines, which count
/// as dropped. Triangles that a strip repeats a vertex in, as those that join strips do, are left out. Throws
/// Error(Input) that names the mesh where attributes and indices do not agree. With a deformation's joints the mesh
/// comes in world space.
Mesh readPrimitive(const Document& document, const json& primitive, const std::string& meshName,
                   const VertexNeeds& needs, const Deformation& deformation, MeshLosses& losses);

}  // namespace antipode::gltf
