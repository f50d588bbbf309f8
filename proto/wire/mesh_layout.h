// How a mesh lies in its blob: positions, normals, uvs, further uvs, colours, tangents, triangles, without padding.
#pragma once

#include <bit>
#include <cstdint>

#include "proto/farm.pb.h"
#include "renderengine/scene.h"

namespace antipode::wire {

static_assert(std::endian::native == std::endian::little, "blobs are little-endian, as are the arrays in memory");
static_assert(sizeof(Vec3f) == 12 && sizeof(Mesh::uvs[0]) == 8 && sizeof(Mesh::moreUvs[0]) == 8 &&
                  sizeof(Mesh::colors[0]) == 16 && sizeof(Mesh::tangents[0]) == 16 && sizeof(Mesh::triangles[0]) == 12,
              "arrays have no padding");

constexpr uint32_t mostFurtherUvSets = 15;

/// At most 2^40, of up to mostFurtherUvSets: sums of as many as a root can hold do not overflow.
inline uint64_t meshBytes(const farm::MeshCounts& counts) {
    const uint64_t perVertex = 12 + (counts.normals() ? 12 : 0) + (counts.uvs() ? 8 : 0) +
                               8 * uint64_t(counts.more_uv_sets()) + (counts.colors() ? 16 : 0) +
                               (counts.tangents() ? 16 : 0);
    return counts.vertices() * perVertex + counts.triangles() * uint64_t(12);
}

}  // namespace antipode::wire
