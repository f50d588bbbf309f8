// The scene as the kernels read it: arrays of texels in host memory, in the layout of kernels/shared/layout.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gpu/bvh.h"
#include "kernels/shared/layout.h"
#include "renderengine/scene.h"
#include "renderengine/set_up_step.h"

namespace antipode {

struct PackedScene {
    uint32_t features = 0;  ///< FEATURE_* bits: what the kernels must be able to do
    uint32_t lobes = 0;     ///< LOBE_* bits, the same of materials
    Bounds3f bounds;        ///< of what rays can meet
    Bvh bvh;
    std::vector<shared::uvec4> primitives, attributes, materials, lights, textureInfo, environmentAlias,
        bodies,                                // by rank, with FEATURE_INTERFACES
        moreAttributes;                        // moreAttributeTexels a primitive, as BIND_MORE_ATTRIBUTES says
    std::vector<uint16_t> texels;              ///< RGBA half floats, linear
    std::vector<shared::vec4> environmentMap;  ///< radiance, solid-angle pdf
    std::vector<shared::vec4> losses;  ///< loss_tables.h: of metal, with LOBE_ROUGH_DIELECTRIC of glass; layer_tables.h
    uint32_t moreAttributeTexels = 0;
    uint32_t lightCount = 0;
    uint32_t environmentLight = shared::NO_INDEX;
    float environmentPick = 0;    ///< probability of picking the environment
    double greatestRadiance = 0;  ///< that the film's scale must have room for
};

/// Bounds of what rays can meet: positions that no triangle uses do not count.
Bounds3f tracedBounds(const Scene& scene);

/// A triangle's box with room for the rounding of the intersection with it.
Bounds3f padded(const Bounds3f& triangle);

/// Builds the BVH. `step` is called before each part.
PackedScene packScene(
    const Scene& scene, const SetUpStep& step = [](const char*) {});

}  // namespace antipode
