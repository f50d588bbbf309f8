// Point, spot and directional lights of an imported file.
#pragma once

#include <assimp/scene.h>

#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// Adds the file's lights in world space. Intensities are taken as W/sr, irradiances as W/m² (glTF's candela and lux
/// are numbers of the same form). glTF and Collada give spot half-angles, FBX full angles. Ambient lights are dropped
/// and area lights become points, with notices.
void importLights(const aiScene& file, const std::string& path, Scene& scene);

}  // namespace antipode
