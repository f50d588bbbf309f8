// The lights of a glTF file (KHR_lights_punctual).
#pragma once

#include "renderengine/import_options.h"
#include "scene/gltf/nodes.h"

namespace antipode::gltf {

/// Adds the lights that shown nodes hold, one for each node, in W/sr and W/m². Throws Error(Input).
void importLights(const Document& document, const Nodes& nodes, LampUnits units, Scene& scene);

}  // namespace antipode::gltf
