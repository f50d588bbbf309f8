// Metres, and +Y up: how an imported file stands in the scene.
#pragma once

#include <assimp/scene.h>

#include "renderengine/import_options.h"
#include "scene/model_format.h"

namespace antipode {

/// Moves the file's root node so that lengths are metres and up is +Y. FBX says its unit (UnitScaleFactor, in
/// centimetres) and up axis, which Assimp 5.2 hands on without applying them; it has brought Collada to metres and +Y.
/// STL knows neither: up is +Z, as in the programs that write it. `options.up` overrules what the file says.
void standUpright(const aiScene& file, ModelFormat format, const ImportOptions& options);

}  // namespace antipode
