// A glTF 2.0 file whose references, sizes and extensions have been checked.
#pragma once

#include <string>
#include <vector>

#include "scene/gltf/buffers.h"

namespace antipode::gltf {

struct Document {
    gltf::json json;
    Buffers buffers;
    std::string directory;  ///< where the names of external files start
};

/// Reads a .gltf or .glb. Extensions that are used and not known become notices, one each. Throws Error(Input), without
/// the path, where the file is not glTF 2.0, is cut short, requires an extension that nobody here implements, its nodes
/// form no trees, or an accessor reaches beyond its buffer; json::exception where the JSON has the wrong form.
Document readDocument(const std::string& path, std::vector<std::string>& notices);

/// True for the extensions .gltf and .glb, in any case.
bool isGltfPath(const std::string& path);

}  // namespace antipode::gltf
