// The binary side of a glTF file: buffers and the views into them, checked down to their last byte.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/json_access.h"

namespace antipode::gltf {

/// Bytes that accessors and images lie in.
struct View {
    std::span<const uint8_t> bytes;
    uint64_t stride = 0;  ///< bytes from one element to the next; 0: elements are tightly packed
};

class Buffers {
public:
    /// Loads all buffers, and decodes compressed views. `chunk`: the BIN chunk of a .glb; `directory`: where external
    /// buffers lie. Throws Error(Input) where a buffer is missing or cut short, or a bufferView reaches beyond its
    /// buffer.
    Buffers(const json& file, std::vector<uint8_t> chunk, const std::string& directory);
    Buffers(Buffers&&) = default;  // views point into what moves along
    Buffers& operator=(Buffers&&) = default;

    /// Throws Error(Input) where there is no such view.
    const View& view(size_t index) const;

private:
    /// What a view or its compressed form refers to.
    std::span<const uint8_t> stretch(const json& view) const;

    std::vector<std::vector<uint8_t>> buffers_, decoded_;
    std::vector<View> views_;
};

}  // namespace antipode::gltf
