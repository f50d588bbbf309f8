// Which side of a triangle is its front, and whether a mesh bounds a volume.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "renderengine/scene.h"

namespace antipode {

/// The triangle's vertices in the order that makes its front the side to which its vertex normals point, where they
/// have a side: exporters that disagree with themselves mean the normals.
std::array<uint32_t, 3> frontByNormals(const Mesh& mesh, const std::array<uint32_t, 3>& triangle);

/// The volume that the mesh bounds, negative where its fronts look into it. Nothing where it bounds none: where an edge
/// is not met by as many triangles from one side as from the other, vertices at one position counting as one.
std::optional<double> enclosedVolume(const Mesh& mesh);

/// Whether the mesh bounds a volume and its fronts look out of it.
bool isClosed(const Mesh& mesh);

}  // namespace antipode
