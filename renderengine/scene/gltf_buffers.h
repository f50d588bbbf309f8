// The binary side of a glTF file, checked before Assimp reads it: Assimp 5.2 trusts sizes and silently drops triangles
// whose indices are out of range.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace antipode {

/// A relative file name without its percent-encoding (RFC 3986), which Assimp 5.2 leaves in: %20 → space.
std::string decodeUri(const std::string& uri);

/// `chunk`: the BIN chunk of a .glb, empty for .gltf; `directory`: where external buffers lie.
/// Throws Error(Input) where a buffer is missing or cut short, a bufferView or accessor reaches beyond its data, or an
/// index of a mesh (which is named) is out of range; nlohmann::json::exception where the JSON has the wrong form.
void checkGltfBuffers(const nlohmann::json& json, std::span<const uint8_t> chunk,
                      const std::filesystem::path& directory);

}  // namespace antipode
