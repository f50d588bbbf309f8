// The camera of a file that Assimp reads.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>

#include "renderengine/scene.h"
#include "scene/collada_document.h"

namespace antipode {

/// What the files say beside Assimp, which reads it otherwise or not at all.
struct CameraFacts {
    const ColladaDocument* collada = nullptr;  ///< null for other formats
    size_t parallelFbx = 0;                    ///< cameras of an FBX with a parallel projection
};

/// Sets the scene's camera to the file's camera called `wanted`, or to the first, and the image's aspect ratio where
/// the file tells it (height 512). False where there is none. Fields of view of Collada are its XML's. Parallel
/// projections of FBX are not read: where all its cameras have one they are left out, where some have they are named in
/// a notice. Throws Error(Input).
bool importCamera(const aiScene& file, const CameraFacts& facts, const std::optional<std::string>& wanted,
                  Scene& scene);

}  // namespace antipode
