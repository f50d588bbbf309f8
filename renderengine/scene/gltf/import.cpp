#include "scene/gltf/import.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "scene/gltf/cameras.h"
#include "scene/gltf/instances.h"
#include "scene/gltf/lights.h"
#include "scene/gltf/materials.h"
#include "scene/gltf/primitives.h"
#include "scene/gltf/textures.h"

namespace antipode::gltf {
namespace {

constexpr size_t kMostTriangles = size_t(1) << 28;

class Importer {
public:
    Importer(const Document& document, const ImportOptions& options, Scene& scene)
        : document_(document),
          lampUnits_(options.lampUnits),
          camera_(options.camera),
          scene_(scene),
          table_(document.directory, options.strict, scene),
          textures_(document, table_),
          poses_(options.animationTime ? poseAt(document, *options.animationTime, scene.notices)
                                       : std::map<size_t, NodePose>{}),
          nodes_(readNodes(document, poses_)) {
        if (!options.animationTime && !list(document.json, "animations").empty())
            scene.notices.push_back("The file is animated and shown at rest; --animation-time shows another time.");
    }

    /// Whether the scene has a camera from the file.
    bool run() {
        std::vector<Placed> placed;
        for (size_t node : nodes_.shown)
            if (document_.json["nodes"][node].contains("mesh")) placed.push_back(placedMesh(node));
        for (const Placed& p : placed)
            if (!p.isDeformed()) usesLeft_[p.mesh] += p.toWorld.size();
        for (const Placed& p : placed) addMesh(p);
        losses_.addNotices(scene_.notices);
        importLights(document_, nodes_, lampUnits_, scene_);
        return importCamera(document_, nodes_, camera_, scene_);
    }

private:
    /// The mesh of a node.
    struct Placed {
        size_t mesh = 0;
        std::vector<Affine> toWorld;  ///< of every instance
        Deformation deformation;

        bool isDeformed() const { return !deformation.morphWeights.empty() || !deformation.jointMatrices.empty(); }
    };

    Placed placedMesh(size_t index) const {
        const json& node = document_.json["nodes"][index];
        Placed placed{natural(node.at("mesh")), {}, {}};
        placed.deformation.morphWeights = morphWeights(index, entry(document_.json, "meshes", placed.mesh));
        if (const auto skin = reference(node, "skin")) {
            placed.deformation.jointMatrices = jointMatrices(document_, *skin, nodes_.toWorld);
            placed.deformation.unbound = nodes_.toWorld[index];
        }
        // A skin's joints say where its mesh stands, whatever the node says (glTF 2.0, 3.7.3.3).
        const Affine toWorld = placed.deformation.jointMatrices.empty() ? nodes_.toWorld[index] : Affine{};
        for (const Affine& instance : instancesOf(document_, node)) placed.toWorld.push_back(toWorld * instance);
        return placed;
    }

    /// Empty where all are 0.
    std::vector<double> morphWeights(size_t index, const json& mesh) const {
        std::vector<double> weights;
        const json& node = document_.json["nodes"][index];
        for (const json& weight : list(node.contains("weights") ? node : mesh, "weights"))
            weights.push_back(weight.get<double>());
        if (const auto posed = poses_.find(index); posed != poses_.end() && posed->second.weights)
            weights = *posed->second.weights;
        if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) weights.clear();
        return weights;
    }

    void addMesh(const Placed& placed) {
        std::vector<Mesh> deformed;
        if (placed.isDeformed()) deformed = readParts(placed.mesh, placed.deformation);
        std::vector<Mesh>& parts = placed.isDeformed() ? deformed : partsOf(placed.mesh);
        size_t usesLeft = placed.isDeformed() ? placed.toWorld.size() : usesLeft_[placed.mesh];
        for (const Affine& toWorld : placed.toWorld) {
            --usesLeft;
            for (Mesh& part : parts) {
                // Most meshes stand in one place; only repeated ones are worth a copy.
                if (!part.triangles.empty()) add(usesLeft == 0 ? std::move(part) : part, toWorld);
            }
        }
        if (!placed.isDeformed()) usesLeft_[placed.mesh] = usesLeft;
    }

    void add(Mesh mesh, const Affine& toWorld) {
        transformMesh(mesh, toWorld);
        losses_.degenerate += dropDegenerateTriangles(mesh);
        checkMesh(mesh);
        triangles_ += mesh.triangles.size();
        if (triangles_ > kMostTriangles)
            fail("with all copies of its meshes it has more than 2^28 triangles, which no device here holds");
        if (!mesh.triangles.empty()) scene_.meshes.push_back(std::move(mesh));
    }

    /// The mesh's primitives in its own space, cleaned.
    std::vector<Mesh>& partsOf(size_t index) {
        const auto [entry, isNew] = parts_.try_emplace(index);
        if (isNew) entry->second = readParts(index, {});
        return entry->second;
    }

    std::vector<Mesh> readParts(size_t index, const Deformation& deformation) {
        const json& from = entry(document_.json, "meshes", index);
        const json& primitives = list(from, "primitives");
        std::vector<Mesh> parts;
        for (const json& primitive : primitives) {
            std::string name = nameOf(from, "mesh", index);
            if (primitives.size() > 1) name.append("-").append(std::to_string(parts.size()));
            // Points and lines have no use for their material.
            const ImportedMaterial* material = hasTriangles(primitive) ? &materialOf(primitive) : nullptr;
            const VertexNeeds needs = material ? material->needs : VertexNeeds{};
            Mesh mesh = readPrimitive(document_, primitive, name, needs, deformation, losses_);
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
            const Material material = readMaterial(from, name, textures_, scene_.notices);
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
    const std::optional<std::string>& camera_;  ///< by its name
    Scene& scene_;
    TextureTable table_;
    Textures textures_;
    std::map<size_t, NodePose> poses_;
    Nodes nodes_;
    size_t triangles_ = 0;
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
