// The camera of an imported file.
#pragma once

#include <assimp/scene.h>

#include "renderengine/scene.h"
#include "scene/gltf_document.h"

namespace antipode {

/// Sets the scene's camera to the file's first perspective camera, and the image's aspect ratio where the file tells it
/// (height 512). False where there is none. `gltf` is null for other formats; for glTF the vertical field of view is
/// read from the JSON, because Assimp 5.2 reports yfov × aspect as the horizontal one.
bool importCamera(const aiScene& file, const GltfDocument* gltf, Scene& scene);

}  // namespace antipode
