#include "scene/gltf_document.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>

#include "renderengine/error.h"
#include "renderengine/io/files.h"
#include "scene/gltf_buffers.h"

namespace antipode {
namespace {

using nlohmann::json;

constexpr uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a;
constexpr size_t kHeaderSize = 12, kChunkHeaderSize = 8;

/// Whoever imports a file puts its name before the message.
[[noreturn]] void fail(const std::string& why) { throw Error(ErrorCode::Input, "not a usable glTF file: " + why); }

uint32_t readU32(const std::vector<uint8_t>& bytes, size_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | uint32_t(bytes[at + 3]) << 24;
}

void appendU32(std::vector<uint8_t>& bytes, uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(uint8_t(value >> shift));
}

/// Where JSON and BIN chunk lie in a file.
struct Layout {
    size_t jsonBegin = 0, jsonEnd = 0;
    size_t binaryBegin = 0, binarySize = 0;
    bool isGlb = false;
};

Layout findJson(const std::vector<uint8_t>& bytes) {
    if (bytes.size() < 4 || readU32(bytes, 0) != kGlbMagic) return {0, bytes.size(), 0, 0, false};
    if (bytes.size() < kHeaderSize + kChunkHeaderSize) fail("it is cut short");
    if (readU32(bytes, 4) != 2) fail("its container version is not 2");
    if (readU32(bytes, 8) > bytes.size()) fail("it is cut short");
    const size_t begin = kHeaderSize + kChunkHeaderSize, size = readU32(bytes, kHeaderSize);
    if (readU32(bytes, kHeaderSize + 4) != kJsonChunk) fail("its first chunk is not JSON");
    if (size > bytes.size() - begin) fail("its JSON is cut short");
    Layout layout{begin, begin + size, 0, 0, true};
    if (bytes.size() - layout.jsonEnd >= kChunkHeaderSize) {
        layout.binarySize = readU32(bytes, layout.jsonEnd);
        layout.binaryBegin = layout.jsonEnd + kChunkHeaderSize;
        if (layout.binarySize > bytes.size() - layout.binaryBegin) fail("its buffer is cut short");
    }
    return layout;
}

/// Copying and writing JSON is recursive, here and in Assimp. Looked at in the text, since the parser's own callback
/// takes quadratic time.
void refuseDeepNesting(std::string_view text) {
    constexpr int kDeepest = 100;
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString && c == '\\')
            ++i;
        else if (c == '"')
            inString = !inString;
        else if (!inString && (c == '[' || c == '{') && ++depth > kDeepest)
            fail("its JSON is nested too deeply");
        else if (!inString && (c == ']' || c == '}'))
            --depth;
    }
}

void checkVersionAndExtensions(const json& j) {
    if (!j.contains("asset") || !j["asset"].value("version", "").starts_with("2"))
        fail("only version 2.0 is supported");
    static const std::set<std::string> known = {
        "KHR_lights_punctual",    "KHR_materials_emissive_strength", "KHR_materials_ior",
        "KHR_materials_specular", "KHR_materials_transmission",      "KHR_materials_volume",
        "KHR_texture_transform",  "KHR_draco_mesh_compression",      "KHR_materials_unlit"};
    for (const std::string extension : j.value("extensionsRequired", json::array())) {
        if (!known.contains(extension)) fail("it requires the extension " + extension);
    }
}

/// Nodes form trees of bounded height: Assimp 5.2 follows a cycle or a very long chain until its stack is full, and a
/// node with two parents twice, its children four times, …
void checkNodes(const json& j) {
    constexpr size_t kMaxHeight = 1000;
    const json nodes = j.value("nodes", json::array());
    std::vector<std::optional<size_t>> parents(nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const json& child : nodes.at(i).value("children", json::array())) {
            std::optional<size_t>& parent = parents.at(child.get<size_t>());
            if (parent) fail("node " + child.dump() + " has two parents");
            parent = i;
        }
    }
    for (size_t i = 0; i < nodes.size(); ++i) {
        size_t height = 0;
        for (auto parent = parents[i]; parent; parent = parents[*parent])
            if (++height > kMaxHeight) fail("its nodes are nested too deeply or in a cycle");
    }
}

void renameToIndices(json& j, const char* array) {
    if (!j.contains(array)) return;
    size_t index = 0;
    for (json& entry : j[array]) entry["name"] = std::to_string(index++);
}

void decodeUris(json& j, const char* array) {
    if (!j.contains(array)) return;
    for (json& entry : j[array]) {
        const std::string uri = entry.value("uri", "");
        if (!uri.empty() && !uri.starts_with("data:")) entry["uri"] = decodeUri(uri);
    }
}

std::vector<uint8_t> withJson(const std::vector<uint8_t>& bytes, const Layout& layout, const json& j) {
    std::string text = j.dump();
    if (!layout.isGlb) return {text.begin(), text.end()};
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
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension == ".gltf" || extension == ".glb";
}

GltfDocument readGltf(const std::string& path) {
    const std::vector<uint8_t> bytes = readFileBytes(path);
    const Layout layout = findJson(bytes);
    refuseDeepNesting(
        {reinterpret_cast<const char*>(bytes.data()) + layout.jsonBegin, layout.jsonEnd - layout.jsonBegin});
    GltfDocument document;
    try {
        document.json = json::parse(bytes.begin() + std::ptrdiff_t(layout.jsonBegin),
                                    bytes.begin() + std::ptrdiff_t(layout.jsonEnd));
        checkVersionAndExtensions(document.json);
        checkNodes(document.json);
        const auto chunk = std::span(bytes).subspan(layout.binaryBegin, layout.binarySize);
        checkGltfBuffers(document.json, chunk, std::filesystem::path(path).parent_path());
        size_t index = 0;
        for (const json& material : document.json.value("materials", json::array()))
            document.materialNames.push_back(material.value("name", "material " + std::to_string(index++)));
        json renamed = document.json;
        renameToIndices(renamed, "materials");
        renameToIndices(renamed, "nodes");
        decodeUris(renamed, "buffers");
        decodeUris(renamed, "images");
        document.renamedFile = withJson(bytes, layout, renamed);
    } catch (const json::exception& e) {
        fail(e.what());
    } catch (const std::out_of_range&) {
        fail("a node refers to a child that does not exist");
    }
    return document;
}

}  // namespace antipode
