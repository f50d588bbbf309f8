#include "scene/gltf/document.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <utility>

#include "scene/gltf/accessors.h"
#include "scene/gltf/container.h"

namespace antipode::gltf {
namespace {

/// What importers here do, or say that they do not.
const std::set<std::string> kKnown = {
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",   "EXT_texture_webp",
    "KHR_draco_mesh_compression", "KHR_lights_punctual",       "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",    "KHR_materials_dispersion",  "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_iridescence", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",        "KHR_materials_specular",    "KHR_materials_transmission",
    "KHR_materials_unlit",        "KHR_materials_variants",    "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_meshopt_compression",   "KHR_texture_transform"};

/// What asks for nothing in a picture.
const std::set<std::string> kInvisible = {"KHR_xmp", "KHR_xmp_json_ld"};

/// What may be required and is read without: a texture that only it describes becomes a checker.
const std::set<std::string> kDispensable = {"KHR_texture_basisu"};

void collectExtensions(const json& value, std::set<std::string>& found) {
    if (value.is_object()) {
        const auto extensions = value.find("extensions");
        if (extensions != value.end() && extensions->is_object())
            for (const auto& [name, content] : extensions->items()) found.insert(name);
    }
    if (value.is_structured())
        for (const json& part : value) collectExtensions(part, found);
}

void checkExtensions(const json& file, std::vector<std::string>& notices) {
    for (const json& required : list(file, "extensionsRequired")) {
        const auto name = required.get<std::string>();
        if (!kKnown.contains(name) && !kInvisible.contains(name) && !kDispensable.contains(name))
            fail("it requires the extension " + name);
    }
    std::set<std::string> used;
    for (const json& name : list(file, "extensionsUsed")) used.insert(name.get<std::string>());
    collectExtensions(file, used);
    for (const std::string& name : used)
        if (!kKnown.contains(name) && !kInvisible.contains(name))
            notices.push_back("The file uses the extension " + name + ", which is ignored.");
    if (used.contains("KHR_materials_variants"))
        notices.push_back("The file has variants of its materials; the first look is shown.");
}

/// Nodes form trees of bounded height.
void checkNodes(const json& file) {
    constexpr size_t kMaxHeight = 1000;
    const json& nodes = list(file, "nodes");
    std::vector<std::optional<size_t>> parents(nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const json& child : list(nodes[i], "children")) {
            const uint64_t index = natural(child);
            if (index >= nodes.size()) fail("a node refers to a child that does not exist");
            if (parents[index]) fail("node " + child.dump() + " has two parents");
            parents[index] = i;
        }
    }
    for (size_t i = 0; i < nodes.size(); ++i) {
        size_t height = 0;
        for (auto parent = parents[i]; parent; parent = parents[*parent])
            if (++height > kMaxHeight) fail("its nodes are nested too deeply or in a cycle");
    }
}

}  // namespace

bool isGltfPath(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension == ".gltf" || extension == ".glb";
}

Document readDocument(const std::string& path, std::vector<std::string>& notices) {
    Container container = readContainer(path);
    const std::string directory = std::filesystem::path(path).parent_path().string();
    checkExtensions(container.document, notices);
    checkNodes(container.document);
    Buffers buffers(container.document, std::move(container.chunk), directory);
    Document document{std::move(container.document), std::move(buffers), directory};
    checkAccessors(document);
    return document;
}

}  // namespace antipode::gltf
