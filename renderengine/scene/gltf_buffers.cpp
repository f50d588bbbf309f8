#include "scene/gltf_buffers.h"

#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "renderengine/error.h"
#include "renderengine/io/files.h"

namespace antipode {
namespace {

using nlohmann::json;

[[noreturn]] void fail(const std::string& why) { throw Error(ErrorCode::Input, "not a usable glTF file: " + why); }

const json& list(const json& parent, const char* key) {
    static const json none = json::array();
    const auto found = parent.find(key);
    return found == parent.end() ? none : *found;
}

/// RFC 4648 without line breaks; stops at padding.
std::vector<uint8_t> decodeBase64(std::string_view text) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    uint32_t bits = 0;
    int count = 0;
    for (char c : text) {
        if (c == '=') break;
        const size_t digit = alphabet.find(c);
        if (digit == std::string_view::npos) fail("a data URI is not base64");
        bits = bits << 6 | uint32_t(digit);
        count += 6;
        if (count >= 8) bytes.push_back(uint8_t(bits >> (count -= 8)));
    }
    return bytes;
}

/// The contents of all buffers, at least as long as they claim.
std::vector<std::vector<uint8_t>> loadBuffers(const json& j, std::span<const uint8_t> chunk,
                                              const std::filesystem::path& directory) {
    std::vector<std::vector<uint8_t>> buffers;
    for (const json& buffer : list(j, "buffers")) {
        const std::string uri = buffer.value("uri", "");
        if (uri.empty())
            buffers.emplace_back(chunk.begin(), chunk.end());
        else if (uri.starts_with("data:"))
            buffers.push_back(decodeBase64(std::string_view(uri).substr(uri.find(',') + 1)));
        else
            buffers.push_back(readFileBytes((directory / decodeUri(uri)).string()));
        if (buffers.back().size() < buffer.at("byteLength").get<uint64_t>())
            fail("buffer " + std::to_string(buffers.size() - 1) + " is cut short");
    }
    return buffers;
}

void checkViews(const json& j, const std::vector<std::vector<uint8_t>>& buffers) {
    for (const json& view : list(j, "bufferViews")) {
        const uint64_t begin = view.value("byteOffset", uint64_t(0)), length = view.at("byteLength");
        const auto buffer = view.at("buffer").get<size_t>();
        if (buffer >= buffers.size() || begin > buffers[buffer].size() || length > buffers[buffer].size() - begin)
            fail("a bufferView reaches beyond its buffer");
    }
}

int componentSize(const json& accessor) {
    static const std::map<int, int> sizes = {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
    const auto found = sizes.find(accessor.at("componentType").get<int>());
    if (found == sizes.end()) fail("an accessor has an unknown component type");
    return found->second;
}

uint64_t elementSize(const json& accessor) {
    static const std::map<std::string, int> counts = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                      {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    const auto found = counts.find(accessor.at("type").get<std::string>());
    if (found == counts.end()) fail("an accessor has an unknown type");
    return uint64_t(found->second) * uint64_t(componentSize(accessor));
}

void checkAccessors(const json& j) {
    const json& accessors = list(j, "accessors");
    for (size_t i = 0; i < accessors.size(); ++i) {
        const json& a = accessors[i];
        if (!a.contains("bufferView")) continue;
        const json& view = list(j, "bufferViews").at(a["bufferView"].get<size_t>());
        const uint64_t size = elementSize(a), count = a.at("count"), stride = view.value("byteStride", size);
        const uint64_t length = view.at("byteLength"), offset = a.value("byteOffset", uint64_t(0));
        const std::string name = "accessor " + std::to_string(i);
        if (stride == 0) fail(name + " has a stride of zero");
        if (count == 0 || offset > length || size > length - offset || count - 1 > (length - offset - size) / stride)
            fail(name + " reaches beyond its bufferView");
    }
}

/// Index accessors are tightly packed.
void checkIndices(const json& j, const std::vector<std::vector<uint8_t>>& buffers) {
    for (const json& mesh : list(j, "meshes")) {
        for (const json& primitive : mesh.at("primitives")) {
            if (!primitive.contains("indices")) continue;
            const json& indices = list(j, "accessors").at(primitive["indices"].get<size_t>());
            if (!indices.contains("bufferView")) continue;
            const auto vertexCount = list(j, "accessors")
                                         .at(primitive.at("attributes").at("POSITION").get<size_t>())
                                         .at("count")
                                         .get<uint64_t>();
            const json& view = list(j, "bufferViews").at(indices["bufferView"].get<size_t>());
            const uint8_t* data = buffers.at(view.at("buffer").get<size_t>()).data() +
                                  view.value("byteOffset", uint64_t(0)) + indices.value("byteOffset", uint64_t(0));
            const int size = componentSize(indices);
            const auto count = indices.at("count").get<uint64_t>();
            for (uint64_t i = 0; i < count; ++i) {
                uint32_t index = 0;  // the format is little-endian, as are the machines that this runs on
                std::memcpy(&index, data + i * uint64_t(size), size_t(size));
                if (index >= vertexCount)
                    throw Error(ErrorCode::Input, "mesh '" + mesh.value("name", "") + "': index " + std::to_string(i) +
                                                      " refers to vertex " + std::to_string(index) + " of " +
                                                      std::to_string(vertexCount));
            }
        }
    }
}

}  // namespace

std::string decodeUri(const std::string& uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size()) {
            text.push_back(char(std::strtol(uri.substr(i + 1, 2).c_str(), nullptr, 16)));
            i += 2;
        } else {
            text.push_back(uri[i]);
        }
    }
    return text;
}

void checkGltfBuffers(const json& j, std::span<const uint8_t> chunk, const std::filesystem::path& directory) {
    const auto buffers = loadBuffers(j, chunk, directory);
    checkViews(j, buffers);
    checkAccessors(j);
    checkIndices(j, buffers);
}

}  // namespace antipode
