// The lights of a glTF file (KHR_lights_punctual).
#pragma once

#include "renderengine/scene.h"
#include "scene/gltf/nodes.h"

namespace antipode::gltf {

/// Adds the lights that shown nodes hold, one for each node. Candela are taken for W/sr and lux for W/m². Throws
/// Error(Input).
void importLights(const Document& document, const Nodes& nodes, Scene& scene);

}  // namespace antipode::gltf
