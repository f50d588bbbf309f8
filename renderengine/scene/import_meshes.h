// Triangles of an imported file.
#pragma once

#include <assimp/scene.h>

#include "renderengine/scene.h"
#include "scene/model_format.h"

namespace antipode {

/// Throws Error(Input) naming the object where a face, a mesh or a node refers to a vertex, a material or a mesh that
/// does not exist, or where the file holds no nodes. To be called before any of Assimp's post-processing, which trusts
/// the indices.
void checkIndices(const aiScene& file);

/// Adds every instance of every mesh in world space; Mesh::material is Assimp's material index. Points, lines and
/// degenerate triangles are dropped with a notice. Vertex colours are those of PLY, whose bytes are sRGB; of other
/// formats they are a notice. Throws Error(Input) naming the mesh for non-finite coordinates.
void importMeshes(const aiScene& file, ModelFormat format, Scene& scene);

}  // namespace antipode
