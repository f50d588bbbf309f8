// The scene as the kernels read it: arrays of texels in host memory, in the layout of kernels/shared/layout.h.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/bvh.h"
#include "kernels/shared/layout.h"
#include "renderengine/scene.h"

namespace antipode {

struct SceneBounds {
    Vec3f least, greatest;
    Vec3f center() const { return least * 0.5f + greatest * 0.5f; }
    /// Radius of the sphere about the centre that holds the box.
    double radius() const { return 0.5 * length(Vec3d(greatest) - Vec3d(least)); }
};

struct PackedScene {
    uint32_t features = 0;  ///< FEATURE_* bits: what the kernels must be able to do
    SceneBounds bounds;
    Bvh bvh;
    std::vector<shared::uvec4> primitives, attributes, materials, lights, textureInfo, environmentAlias;
    std::vector<uint16_t> texels;              ///< RGBA half floats, linear
    std::vector<shared::vec4> environmentMap;  ///< radiance, solid-angle pdf
    uint32_t lightCount = 0;
    uint32_t environmentLight = shared::NO_INDEX;
    float environmentPick = 0;    ///< probability of picking the environment
    double greatestRadiance = 0;  ///< of what the camera may see, for the film's scale
};

SceneBounds boundsOf(const Scene& scene);

/// `roulette`: give materials a survival probability below 1. Builds the BVH.
PackedScene packScene(const Scene& scene, bool roulette);

}  // namespace antipode
