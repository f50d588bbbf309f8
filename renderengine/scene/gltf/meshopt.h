// Buffer views that meshoptimizer compressed (EXT_meshopt_compression).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/gltf/json_access.h"

namespace antipode::gltf {

/// Decodes what the extension describes from its compressed bytes. Throws Error(Input) where they are damaged or ask
/// for more than so many bytes can hold.
std::vector<uint8_t> decodeMeshopt(const json& extension, std::span<const uint8_t> compressed);

}  // namespace antipode::gltf
