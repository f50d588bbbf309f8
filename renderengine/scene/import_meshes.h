// Triangles of an imported file.
#pragma once

#include <assimp/scene.h>

#include "renderengine/scene.h"

namespace antipode {

/// Throws Error(Input) naming the object where a face, a mesh or a node refers to a vertex, a material or a mesh that
/// does not exist, or where the file holds no nodes. To be called before any of Assimp's post-processing, which trusts
/// the indices.
void checkIndices(const aiScene& file);

/// Adds every instance of every mesh in world space; Mesh::material is Assimp's material index. Points, lines and
/// degenerate triangles are dropped with a notice, normals that are not finite replaced. Vertex colours are taken for
/// sRGB; further sets of texture coordinates come where a texture of the material asks for them. Throws Error(Input)
/// naming the mesh for other non-finite coordinates.
void importMeshes(const aiScene& file, Scene& scene);

}  // namespace antipode
