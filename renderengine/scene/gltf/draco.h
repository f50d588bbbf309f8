// Geometry that Google's Draco compressed (KHR_draco_mesh_compression).
#pragma once

#include <map>
#include <string>

#include "scene/gltf/accessors.h"

namespace antipode::gltf {

struct DracoGeometry {
    std::vector<uint32_t> corners;             ///< three a triangle
    std::map<std::string, Values> attributes;  ///< by semantic: "POSITION", …
};

/// Decodes what a primitive's extension refers to. The primitive's accessors say which integers are normalised. Throws
/// Error(Input) where the data are damaged.
DracoGeometry decodeDraco(const Document& document, const json& primitive);

}  // namespace antipode::gltf
