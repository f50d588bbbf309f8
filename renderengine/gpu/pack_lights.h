// Light records, the alias table that picks one by power, and the environment map's own.
#pragma once

#include "gpu/emitted_power.h"
#include "gpu/packed_scene.h"

namespace antipode {

/// Fills the light tables, and the light index of every emitting primitive.
void packLights(const Scene& scene, const std::vector<EmitterPrimitive>& emitters, const SetUpStep& step,
                PackedScene& packed);

}  // namespace antipode
