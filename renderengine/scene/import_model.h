// Importing a mesh file without adding anything to it, for scenes that put models together.
#pragma once

#include <functional>
#include <string>

#include "renderengine/import_options.h"

namespace antipode {

struct ImportedModel {
    Scene scene;             ///< only what the file holds; not validated, may lack surfaces and lights
    bool hasCamera = false;  ///< scene.camera comes from the file
};

/// Throws Error(Input) naming the file.
ImportedModel importModelParts(const std::string& path, const ImportOptions& options = {});

/// importModel() of a scene that `change` changes, where it is given, before it is seen what light the scene lacks.
/// What `change` throws is passed on.
Scene importModel(const std::string& path, const ImportOptions& options, const std::function<void(Scene&)>& change);

}  // namespace antipode
