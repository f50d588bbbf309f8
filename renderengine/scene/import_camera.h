// The camera of a file that Assimp reads.
#pragma once

#include <assimp/scene.h>

#include "renderengine/scene.h"

namespace antipode {

/// Sets the scene's camera to the file's first perspective camera, and the image's aspect ratio where the file tells it
/// (height 512). False where there is none.
bool importCamera(const aiScene& file, Scene& scene);

}  // namespace antipode
