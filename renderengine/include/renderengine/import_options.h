// What decides how a model file becomes a scene, beside what the file says.
#pragma once

#include <string>

#include "renderengine/scene.h"

namespace antipode {

struct ImportOptions {
    bool strict = false;  ///< an image that is missing or cannot be decoded is an error instead of a substitute
};

/// importModel() as these options say.
Scene importModel(const std::string& path, const ImportOptions& options);

}  // namespace antipode
