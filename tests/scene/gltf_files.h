// glTF files put together in tests: accessors of any type, with their data, in one buffer.
#pragma once

#include <cstring>
#include <span>

#include "tests/scene/model_files.h"

namespace antipode::testing {

/// A file whose lists grow: each function returns the index of what it added.
struct GltfFile {
    nlohmann::json json = nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "buffers": [{}]})");
    std::vector<uint8_t> binary;

    size_t addView(std::span<const uint8_t> bytes, size_t stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4);
        nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (stride != 0) view["byteStride"] = stride;
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        return add("bufferViews", view);
    }
    template <class T>
    size_t addView(const std::vector<T>& values, size_t stride = 0) {
        return addView({reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)}, stride);
    }
    /// `type`: "SCALAR", "VEC2" …
    template <class T>
    size_t addAccessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
        constexpr std::pair<const char*, size_t> sizes[] = {
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
        size_t components = 0;
        for (const auto& [name, size] : sizes)
            if (type == name) components = size;
        nlohmann::json accessor = {{"bufferView", addView(values)},
                                   {"componentType", componentType(T{})},
                                   {"count", values.size() / components},
                                   {"type", type}};
        if (normalized) accessor["normalized"] = true;
        return add("accessors", accessor);
    }
    /// A mesh of one primitive in a node of its own at the scene's root; returns the node.
    size_t addMesh(const nlohmann::json& primitive) {
        const size_t mesh = add("meshes", {{"name", "m"}, {"primitives", {primitive}}});
        return add("nodes", {{"mesh", mesh}});
    }
    size_t add(const char* list, const nlohmann::json& entry) {
        json[list].push_back(entry);
        return json[list].size() - 1;
    }
    std::vector<uint8_t> glb() const {
        nlohmann::json whole = json;
        whole["buffers"][0]["byteLength"] = binary.size();
        return makeGlb(whole, binary);
    }

    static int componentType(int8_t) { return 5120; }
    static int componentType(uint8_t) { return 5121; }
    static int componentType(int16_t) { return 5122; }
    static int componentType(uint16_t) { return 5123; }
    static int componentType(uint32_t) { return 5125; }
    static int componentType(float) { return 5126; }
};

/// (0,0,0) (1,0,0) (0,1,0) (1,1,0): two triangles as a strip.
inline std::vector<float> squarePositions() { return {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}; }

}  // namespace antipode::testing
