// The two forms of a glTF 2.0 file, text and .glb, taken apart.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderengine/error.h"
#include "scene/gltf/json_access.h"

namespace antipode::gltf {

struct Container {
    json document;
    std::vector<uint8_t> chunk;  ///< the BIN chunk of a .glb, else empty
};

/// What is thrown for glTF 1.0, whose accessors, materials and shaders are another format's.
class FirstVersion : public Error {
public:
    FirstVersion() : Error(ErrorCode::Input, "not a usable glTF file: only version 2.0 is supported") {}
};

/// Throws FirstVersion, and Error(Input) where the file is cut short, its JSON is broken or nested too deeply, or its
/// version is neither 1 nor 2.
Container readContainer(const std::string& path);

/// A relative file name without its percent-encoding (RFC 3986): %20 → space.
std::string decodeUri(const std::string& uri);

/// What a data URI holds (RFC 2397, RFC 4648 without line breaks). Throws Error(Input).
std::vector<uint8_t> decodeDataUri(std::string_view uri);

}  // namespace antipode::gltf
