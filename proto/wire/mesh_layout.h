// How a mesh lies in its blob: positions, normals, uvs, triangles, without padding.
#pragma once

#include <bit>
#include <cstdint>

#include "proto/farm.pb.h"
#include "renderengine/scene.h"

namespace antipode::wire {

static_assert(std::endian::native == std::endian::little, "blobs are little-endian, as are the arrays in memory");
static_assert(sizeof(Vec3f) == 12 && sizeof(Mesh::uvs[0]) == 8 && sizeof(Mesh::triangles[0]) == 12,
              "arrays have no padding");

/// At most 2^38: sums of as many as a root can hold do not overflow.
inline uint64_t meshBytes(const farm::MeshCounts& counts) {
    const uint64_t perVertex = 12 + (counts.normals() ? 12 : 0) + (counts.uvs() ? 8 : 0);
    return counts.vertices() * perVertex + counts.triangles() * uint64_t(12);
}

}  // namespace antipode::wire
