// Light records, the alias table that picks one by power, and the environment map's own.
#pragma once

#include "gpu/packed_scene.h"

namespace antipode {

/// One emitter that is a primitive: its index in BVH order, its material, its area.
struct EmitterPrimitive {
    uint32_t primitive, material;
    double area;
    bool sphere;
};

/// Fills the light tables, and the light index of every emitting primitive.
void packLights(const Scene& scene, const std::vector<EmitterPrimitive>& emitters, PackedScene& packed);

}  // namespace antipode
