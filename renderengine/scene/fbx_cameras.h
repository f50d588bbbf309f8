// Cameras of FBX with a parallel projection, which Assimp 5.2 hands over as perspective ones.
#pragma once

#include <cstddef>
#include <string>

namespace antipode {

/// How many cameras of the file, text or binary, say CameraProjectionType 1. Names are not told. Throws Error(Input)
/// where the file cannot be read.
size_t countParallelFbxCameras(const std::string& path);

}  // namespace antipode
