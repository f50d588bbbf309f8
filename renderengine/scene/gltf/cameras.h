// The camera of a glTF file.
#pragma once

#include <optional>
#include <string>

#include "renderengine/scene.h"
#include "scene/gltf/nodes.h"

namespace antipode::gltf {

/// Sets the scene's camera to the one called `wanted`, or to the first of the file's cameras that a shown node holds,
/// and the image's aspect ratio where the file tells it (height 512). False where there is none. Throws Error(Input).
bool importCamera(const Document& document, const Nodes& nodes, const std::optional<std::string>& wanted, Scene& scene);

}  // namespace antipode::gltf
