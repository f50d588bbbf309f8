// What each emitting primitive gives, which decides how often it is drawn.
#pragma once

#include <functional>
#include <vector>

#include "gpu/more_attributes.h"
#include "renderengine/scene.h"

namespace antipode {

/// One emitter that is a primitive: its index in BVH order, its material, its area, and where its textures are read.
struct EmitterPrimitive {
    uint32_t primitive, material;
    double area;
    bool sphere;
    const Mesh* mesh = nullptr;         ///< of a sphere none
    std::array<uint32_t, 3> corners{};  ///< of the mesh's vertices

    /// Texture coordinates of a set; of a sphere all 0, as in the kernels.
    UvTriangle uvs(uint32_t set) const { return mesh ? uvsOf(*mesh, corners, set) : UvTriangle{}; }
};

/// The power of each, W, mean of the channels: radiance over the texels that it shows and the part of it that is no
/// hole, both by all texels that it touches, × π × area × sides. 0 only where it emits nothing. Takes time in
/// proportion to the textures' texels and the number of emitters. `nextTexture` is called before each texture that is
/// summed.
std::vector<double> emittedPowers(const Scene& scene, const std::vector<EmitterPrimitive>& emitters,
                                  const std::function<void()>& nextTexture);

}  // namespace antipode
