#include "scene/import_model.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <optional>
#include <vector>

#include "renderengine/error.h"
#include "scene/defaults.h"
#include "scene/gltf_document.h"
#include "scene/import_camera.h"
#include "scene/import_lights.h"
#include "scene/import_materials.h"
#include "scene/import_meshes.h"

namespace antipode {
namespace {

/// Serves one file from memory and all others from disk.
class OverlayIoSystem : public Assimp::DefaultIOSystem {
public:
    OverlayIoSystem(std::string path, const std::vector<uint8_t>& bytes) : path_(std::move(path)), bytes_(bytes) {}

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (path_ == file) return new Assimp::MemoryIOStream(bytes_.data(), bytes_.size());
        return DefaultIOSystem::Open(file, mode);
    }

private:
    std::string path_;
    const std::vector<uint8_t>& bytes_;
};

/// Keeps the materials that meshes use, in Assimp's order, and renumbers the meshes.
void adoptMaterials(std::vector<std::optional<Material>> materials, Scene& scene) {
    std::vector<uint32_t> newIndex(materials.size());
    for (size_t i = 0; i < materials.size(); ++i) {
        if (!materials[i]) continue;
        newIndex[i] = uint32_t(scene.materials.size());
        scene.materials.push_back(std::move(*materials[i]));
    }
    for (Mesh& mesh : scene.meshes) mesh.material = newIndex.at(mesh.material);
}

ImportedModel importWithAssimp(const std::string& path) {
    std::optional<GltfDocument> gltf;
    Assimp::Importer importer;
    if (isGltfPath(path)) {
        gltf = readGltf(path);
        importer.SetIOHandler(new OverlayIoSystem(path, gltf->renamedFile));  // the importer owns it
    }
    if (!importer.ReadFile(path, 0)) throw Error(ErrorCode::Input, importer.GetErrorString());
    checkFaceIndices(*importer.GetScene());
    const aiScene* file = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (!file || !file->mRootNode) throw Error(ErrorCode::Input, importer.GetErrorString());

    ImportedModel model;
    model.scene.name = std::filesystem::path(path).stem().string();
    const GltfDocument* document = gltf ? &*gltf : nullptr;
    importMeshes(*file, model.scene);
    adoptMaterials(importMaterials(*file, document, std::filesystem::path(path).parent_path().string(), model.scene),
                   model.scene);
    importLights(*file, path, model.scene);
    model.hasCamera = importCamera(*file, document, model.scene);
    return model;
}

}  // namespace

ImportedModel importModelParts(const std::string& path) {
    if (!std::filesystem::is_regular_file(path))
        throw Error(ErrorCode::Input, "'" + path + "' does not exist or is not a file");
    try {
        return importWithAssimp(path);
    } catch (const Error& e) {
        throw Error(e.code(), "cannot import '" + path + "': " + e.what());
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::Input, "cannot import '" + path + "': " + e.what());
    }
}

Scene importModel(const std::string& path) {
    ImportedModel model = importModelParts(path);
    if (!model.hasCamera) addDefaultCamera(model.scene);
    addDefaultLight(model.scene);
    validate(model.scene);
    return std::move(model.scene);
}

}  // namespace antipode
