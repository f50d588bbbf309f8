// The camera of a file that Assimp reads.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>

#include "renderengine/scene.h"
#include "scene/collada_document.h"

namespace antipode {

/// Sets the scene's camera to the file's perspective camera called `wanted`, or to the first, and the image's aspect
/// ratio where the file tells it (height 512). False where there is none. Fields of view of Collada, where `collada` is
/// not null, are its XML's. Throws Error(Input).
bool importCamera(const aiScene& file, const ColladaDocument* collada, const std::optional<std::string>& wanted,
                  Scene& scene);

}  // namespace antipode
