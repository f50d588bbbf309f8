// What every mesh goes through on its way into a scene, whichever file it came from.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

/// Throws Error(Input) naming the mesh where a coordinate is not finite, an array has the wrong length or a triangle
/// refers to a vertex that does not exist.
void checkMesh(const Mesh& mesh);

/// Removes triangles whose area is exactly zero (needles stay) and says how many there were. Needs a checked mesh.
size_t dropDegenerateTriangles(Mesh& mesh);

/// Gives unit length to all normals; a zero normal becomes that of a triangle which uses it. Needs a checked mesh
/// without degenerate triangles. Normals that are unit to float precision keep every bit.
void normalizeNormals(Mesh& mesh);

/// Drops normals that say nothing beyond the triangles' own: those that equal the face normals to float precision. Also
/// drops one constant normal on faces of several directions, which some converters write, and returns true for it,
/// since shading would contradict the surface everywhere. Needs normalised normals and no degenerate triangles.
bool dropIdleNormals(Mesh& mesh);

/// Merges vertices that agree in every bit of all attributes, and drops those that no triangle uses. The order
/// of triangles is kept.
void joinVertices(Mesh& mesh);

/// What was left out of meshes, over all of a file.
struct MeshLosses {
    size_t degenerate = 0, otherPrimitives = 0, normalsNotFinite = 0;
    std::vector<std::string> constantNormals, withoutPositions;  ///< names of meshes
    std::set<std::string> withoutUvs, clampedColors;             ///< likewise

    void addNotices(std::vector<std::string>& notices) const;
};

/// All of the above, in this order. Throws Error(Input) as checkMesh() does.
void cleanMesh(Mesh& mesh, MeshLosses& losses);

}  // namespace antipode
