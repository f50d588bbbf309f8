#include "scene/gltf_document.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>

#include "renderengine/error.h"
#include "scene/file_bytes.h"

namespace antipode {
namespace {

using nlohmann::json;

constexpr uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a;
constexpr size_t kHeaderSize = 12, kChunkHeaderSize = 8;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::Input, "'" + path + "' is not a usable glTF file: " + why);
}

uint32_t readU32(const std::vector<uint8_t>& bytes, size_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | uint32_t(bytes[at + 3]) << 24;
}

void appendU32(std::vector<uint8_t>& bytes, uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(uint8_t(value >> shift));
}

/// Where the JSON lies in a file, and how many bytes of BIN chunk follow it.
struct Layout {
    size_t jsonBegin = 0, jsonEnd = 0, binarySize = 0;
    bool binary = false;
};

Layout findJson(const std::string& path, const std::vector<uint8_t>& bytes) {
    if (bytes.size() < 4 || readU32(bytes, 0) != kGlbMagic) return {0, bytes.size(), 0, false};
    if (bytes.size() < kHeaderSize + kChunkHeaderSize) fail(path, "it is cut short");
    if (readU32(bytes, 4) != 2) fail(path, "its container version is not 2");
    if (readU32(bytes, 8) > bytes.size()) fail(path, "it is cut short");
    const size_t begin = kHeaderSize + kChunkHeaderSize, size = readU32(bytes, kHeaderSize);
    if (readU32(bytes, kHeaderSize + 4) != kJsonChunk) fail(path, "its first chunk is not JSON");
    if (size > bytes.size() - begin) fail(path, "its JSON is cut short");
    Layout layout{begin, begin + size, 0, true};
    if (bytes.size() - layout.jsonEnd >= kChunkHeaderSize) {
        layout.binarySize = readU32(bytes, layout.jsonEnd);
        if (layout.binarySize > bytes.size() - layout.jsonEnd - kChunkHeaderSize) fail(path, "its buffer is cut short");
    }
    return layout;
}

/// The number of bytes that one element of an accessor takes.
uint64_t elementSize(const json& accessor) {
    static const std::map<std::string, int> components = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                          {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    static const std::map<int, int> bytes = {{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
    return uint64_t(components.at(accessor.at("type"))) * bytes.at(accessor.at("componentType"));
}

/// Assimp trusts offsets and counts; a file that lies about them must not make it read elsewhere.
void checkBuffers(const std::string& path, const json& j, const Layout& layout) {
    const json none = json::array();
    const json& buffers = j.contains("buffers") ? j["buffers"] : none;
    const json& views = j.contains("bufferViews") ? j["bufferViews"] : none;
    const json& accessors = j.contains("accessors") ? j["accessors"] : none;
    for (const json& buffer : buffers) {
        const uint64_t size = buffer.at("byteLength");
        const std::string uri = buffer.value("uri", "");
        if (uri.empty()) {
            if (!layout.binary || size > layout.binarySize) fail(path, "a buffer is larger than its data");
        } else if (!uri.starts_with("data:")) {
            std::error_code code;
            const auto file = std::filesystem::path(path).parent_path() / uri;
            const uint64_t actual = std::filesystem::file_size(file, code);
            // Percent-encoded names are left to Assimp, which reports a missing file itself.
            if (!code && size > actual) fail(path, "its buffer '" + uri + "' is cut short");
        }
    }
    for (const json& view : views) {
        const uint64_t end = view.value("byteOffset", uint64_t(0)) + view.at("byteLength").get<uint64_t>();
        if (end > buffers.at(view.at("buffer")).at("byteLength").get<uint64_t>())
            fail(path, "a bufferView reaches beyond its buffer");
    }
    for (size_t i = 0; i < accessors.size(); ++i) {
        const json& a = accessors[i];
        if (!a.contains("bufferView")) continue;
        const json& view = views.at(a["bufferView"]);
        const uint64_t size = elementSize(a), count = a.at("count"), stride = view.value("byteStride", size);
        const uint64_t length = view.at("byteLength"), offset = a.value("byteOffset", uint64_t(0));
        if (count == 0 || offset > length || size > length - offset || (count - 1) > (length - offset - size) / stride)
            fail(path, "accessor " + std::to_string(i) + " reaches beyond its bufferView");
    }
}

void checkVersionAndExtensions(const std::string& path, const json& j) {
    if (!j.contains("asset") || !j["asset"].value("version", "").starts_with("2"))
        fail(path, "only version 2.0 is supported");
    static const std::set<std::string> known = {
        "KHR_lights_punctual",   "KHR_materials_emissive_strength", "KHR_materials_ior",
        "KHR_materials_specular", "KHR_materials_transmission",     "KHR_materials_volume",
        "KHR_texture_transform",  "KHR_draco_mesh_compression",     "KHR_materials_unlit"};
    for (const std::string extension : j.value("extensionsRequired", json::array())) {
        if (!known.contains(extension)) fail(path, "it requires the extension " + extension);
    }
}

void renameToIndices(json& j, const char* array) {
    if (!j.contains(array)) return;
    size_t index = 0;
    for (json& entry : j[array]) entry["name"] = std::to_string(index++);
}

std::vector<uint8_t> withJson(const std::vector<uint8_t>& bytes, const Layout& layout, const json& j) {
    std::string text = j.dump();
    if (!layout.binary) return {text.begin(), text.end()};
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<uint8_t> out;
    const size_t rest = bytes.size() - layout.jsonEnd;
    out.reserve(kHeaderSize + kChunkHeaderSize + text.size() + rest);
    appendU32(out, kGlbMagic);
    appendU32(out, 2);
    appendU32(out, uint32_t(kHeaderSize + kChunkHeaderSize + text.size() + rest));
    appendU32(out, uint32_t(text.size()));
    appendU32(out, kJsonChunk);
    out.insert(out.end(), text.begin(), text.end());
    out.insert(out.end(), bytes.begin() + std::ptrdiff_t(layout.jsonEnd), bytes.end());
    return out;
}

}  // namespace

std::optional<size_t> GltfDocument::find(const char* array, const std::string& name) const {
    size_t index = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
    if (error != std::errc() || end != name.data() + name.size()) return {};
    if (!json.contains(array) || index >= json[array].size()) return {};
    return index;
}

bool isGltfPath(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension == ".gltf" || extension == ".glb";
}

GltfDocument readGltf(const std::string& path) {
    const std::vector<uint8_t> bytes = readFileBytes(path);
    const Layout layout = findJson(path, bytes);
    GltfDocument document;
    try {
        document.json = json::parse(bytes.begin() + std::ptrdiff_t(layout.jsonBegin),
                                    bytes.begin() + std::ptrdiff_t(layout.jsonEnd));
        checkVersionAndExtensions(path, document.json);
        checkBuffers(path, document.json, layout);
        size_t index = 0;
        for (const json& material : document.json.value("materials", json::array()))
            document.materialNames.push_back(material.value("name", "material " + std::to_string(index++)));
        json renamed = document.json;
        renameToIndices(renamed, "materials");
        renameToIndices(renamed, "nodes");
        document.renamedFile = withJson(bytes, layout, renamed);
    } catch (const json::exception& e) {
        fail(path, e.what());
    } catch (const std::out_of_range&) {
        fail(path, "an accessor has an unknown type");
    }
    return document;
}

}  // namespace antipode
