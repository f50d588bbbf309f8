// The JSON of a glTF 2.0 file, read beside Assimp for what Assimp 5.2 drops or distorts.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace antipode {

/// A glTF file whose buffers have been checked and whose materials and nodes have been renamed to their indices ("0",
/// "1", …): Assimp lists materials in the order of first use and drops unused ones, so the name is the only safe way
/// back to the JSON entry.
struct GltfDocument {
    nlohmann::json json;                     ///< with the file's own names
    std::vector<std::string> materialNames;  ///< as in the file, or "material N"
    std::vector<uint8_t> renamedFile;        ///< the .gltf or .glb for Assimp: names replaced, URIs percent-decoded

    /// The index in `array` ("materials", "nodes") of what Assimp calls `name`; nothing for Assimp's own inventions.
    std::optional<size_t> find(const char* array, const std::string& name) const;
};

/// True for the extensions .gltf and .glb, in any case.
bool isGltfPath(const std::string& path);

/// Reads the JSON chunk of a .glb or the whole .gltf. Throws Error(Input), without the path, where the file is not
/// glTF 2.0, is cut short, requires an extension that nobody here implements, or an accessor reaches beyond its buffer.
GltfDocument readGltf(const std::string& path);

}  // namespace antipode
