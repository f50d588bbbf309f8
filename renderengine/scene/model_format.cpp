#include "scene/model_format.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace antipode {

ModelFormat formatOf(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension == ".obj") return ModelFormat::Wavefront;
    if (extension == ".fbx") return ModelFormat::Fbx;
    if (extension == ".dae") return ModelFormat::Collada;
    if (extension == ".stl") return ModelFormat::Stl;
    if (extension == ".ply") return ModelFormat::Ply;
    return ModelFormat::Other;
}

}  // namespace antipode
