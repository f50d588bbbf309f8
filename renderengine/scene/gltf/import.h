// Importing glTF 2.0.
#pragma once

#include "scene/import_model.h"

namespace antipode::gltf {

/// What a .gltf or .glb holds. Throws Error(Input) or another exception, without the path.
ImportedModel importFile(const std::string& path, const ImportOptions& options);

}  // namespace antipode::gltf
