// What decides how a model file becomes a scene, beside what the file says.
#pragma once

#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// Which axis of a model points up; the scene's is +Y.
enum class UpAxis { AsInFile, Y, Z };

struct ImportOptions {
    bool strict = false;  ///< an image that is missing or cannot be decoded is an error instead of a substitute
    UpAxis up = UpAxis::AsInFile;  ///< of models that are not glTF; STL, which does not say, has Z
};

/// importModel() as these options say.
Scene importModel(const std::string& path, const ImportOptions& options);

}  // namespace antipode
