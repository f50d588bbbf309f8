// What few meshes have of their vertices: tangents, colours, further texture coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gpu/texel_sums.h"
#include "kernels/shared/layout.h"
#include "renderengine/scene.h"

namespace antipode {

/// The records of BIND_MORE_ATTRIBUTES: the same parts for every primitive of the scene, none where no mesh needs them.
class MoreAttributes {
public:
    explicit MoreAttributes(const Scene& scene);

    uint32_t features() const { return features_; }
    /// Of each primitive.
    uint32_t texels() const { return texels_; }
    void pack(const Mesh& mesh, const std::array<uint32_t, 3>& triangle, std::vector<shared::uvec4>& to) const;
    void packSphere(std::vector<shared::uvec4>& to) const;

private:
    uint32_t features_ = 0, texels_ = 0, furtherUvSets_ = 0;
};

/// A triangle's texture coordinates of one set; zeros where the mesh has none. A mesh without further sets has set 0
/// for all.
UvTriangle uvsOf(const Mesh& mesh, const std::array<uint32_t, 3>& triangle, uint32_t set);

}  // namespace antipode
