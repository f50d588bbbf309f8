// Point, spot and directional lights of an imported file.
#pragma once

#include <assimp/scene.h>

#include "renderengine/scene.h"
#include "scene/collada_document.h"
#include "scene/model_format.h"

namespace antipode {

/// Adds the file's lights in world space. FBX and Collada hold the power of a point or spot, W watts, which at lengths
/// in metres is W/(4π) W/sr; of other formats, numbers are W/sr. Of directional lights they are W/m². FBX gives the
/// full angles of a spot, Collada see ColladaDocument. What has no shape here becomes a point light or is dropped, with
/// a notice. `collada` is null for other formats.
void importLights(const aiScene& file, ModelFormat format, const ColladaDocument* collada, Scene& scene);

}  // namespace antipode
