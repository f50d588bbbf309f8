#include "scene/gltf/import.h"

#include <map>
#include <optional>
#include <utility>

#include "scene/gltf/cameras.h"
#include "scene/gltf/lights.h"
#include "scene/gltf/primitives.h"
#include "scene/gltf/textures.h"
#include "scene/gltf_materials.h"

namespace antipode::gltf {
namespace {

class Importer {
public:
    Importer(const Document& document, const ImportOptions& options, Scene& scene)
        : document_(document),
          lampUnits_(options.lampUnits),
          scene_(scene),
          table_(document.directory, options.strict, scene),
          textures_(document, table_),
          nodes_(readNodes(document)) {}

    /// Whether the scene has a camera from the file.
    bool run() {
        for (size_t node : nodes_.shown)
            if (const auto mesh = reference(document_.json["nodes"][node], "mesh")) ++usesLeft_[*mesh];
        for (size_t node : nodes_.shown)
            if (const auto mesh = reference(document_.json["nodes"][node], "mesh"))
                addMesh(*mesh, nodes_.toWorld[node]);
        losses_.addNotices(scene_.notices);
        importLights(document_, nodes_, lampUnits_, scene_);
        return importCamera(document_, nodes_, scene_);
    }

private:
    void addMesh(size_t index, const Affine& toWorld) {
        const bool isLast = --usesLeft_[index] == 0;
        std::vector<Mesh>& parts = partsOf(index);
        for (Mesh& part : parts) {
            if (part.triangles.empty()) continue;
            // Most meshes stand in one place; only repeated ones are worth a copy.
            Mesh mesh = isLast ? std::move(part) : part;
            transformMesh(mesh, toWorld);
            losses_.degenerate += dropDegenerateTriangles(mesh);
            checkMesh(mesh);
            if (!mesh.triangles.empty()) scene_.meshes.push_back(std::move(mesh));
        }
    }

    /// The mesh's primitives in its own space, cleaned.
    std::vector<Mesh>& partsOf(size_t index) {
        const auto [entry, isNew] = parts_.try_emplace(index);
        if (isNew) entry->second = readParts(index);
        return entry->second;
    }

    std::vector<Mesh> readParts(size_t index) {
        const json& from = entry(document_.json, "meshes", index);
        const json& primitives = list(from, "primitives");
        std::vector<Mesh> parts;
        for (const json& primitive : primitives) {
            std::string name = nameOf(from, "mesh", index);
            if (primitives.size() > 1) name.append("-").append(std::to_string(parts.size()));
            // Points and lines have no use for their material.
            const ImportedMaterial* material = hasTriangles(primitive) ? &materialOf(primitive) : nullptr;
            Mesh mesh = readPrimitive(document_, primitive, name, material ? material->needs : VertexNeeds{}, losses_);
            if (material) mesh.material = material->index;
            cleanMesh(mesh, losses_);
            parts.push_back(std::move(mesh));
        }
        return parts;
    }

    struct ImportedMaterial {
        uint32_t index = 0;  ///< in the scene
        VertexNeeds needs;
    };

    const ImportedMaterial& materialOf(const json& primitive) {
        const auto index = reference(primitive, "material");
        const auto [known, isNew] = materials_.try_emplace(index);
        if (isNew) {
            const json* from = index ? &entry(document_.json, "materials", *index) : nullptr;
            const std::string name = from ? nameOf(*from, "material", *index) : "default";
            const Material material = importGltfMaterial(from, name, textures_, scene_.notices);
            known->second.index = uint32_t(scene_.materials.size());
            VertexNeeds& needs = known->second.needs;
            needs.uvStreams = textures_.takeUvStreams();
            needs.textured = !needs.uvStreams.empty();
            needs.tangents = material.normalTexture.has_value();
            scene_.materials.push_back(material);
        }
        return known->second;
    }

    const Document& document_;
    LampUnits lampUnits_;
    Scene& scene_;
    TextureTable table_;
    Textures textures_;
    Nodes nodes_;
    MeshLosses losses_;
    std::map<size_t, size_t> usesLeft_;                            ///< of meshes
    std::map<size_t, std::vector<Mesh>> parts_;                    ///< of meshes
    std::map<std::optional<size_t>, ImportedMaterial> materials_;  ///< nothing: the format's default
};

}  // namespace

ImportedModel importFile(const std::string& path, const ImportOptions& options) {
    ImportedModel model;
    try {
        const Document document = readDocument(path, model.scene.notices);
        model.hasCamera = Importer(document, options, model.scene).run();
    } catch (const json::exception& e) {
        fail(e.what());
    }
    return model;
}

}  // namespace antipode::gltf
