// Triangles of an imported file.
#pragma once

#include <assimp/scene.h>

#include "renderengine/scene.h"

namespace antipode {

/// Throws Error(Input) naming the mesh where a face refers to a vertex that does not exist. To be called before any of
/// Assimp's post-processing, which trusts the indices.
void checkFaceIndices(const aiScene& file);

/// Adds every instance of every mesh in world space; Mesh::material is Assimp's material index. Points, lines and
/// degenerate triangles are dropped with a notice. Throws Error(Input) naming the mesh for non-finite coordinates.
void importMeshes(const aiScene& file, Scene& scene);

}  // namespace antipode
