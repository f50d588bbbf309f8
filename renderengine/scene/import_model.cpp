#include "scene/import_model.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <optional>
#include <vector>

#include "renderengine/error.h"
#include "renderengine/io/files.h"
#include "renderengine/io/text.h"
#include "scene/defaults.h"
#include "scene/gltf/container.h"
#include "scene/gltf/document.h"
#include "scene/gltf/import.h"
#include "scene/classic_lobes.h"
#include "scene/collada_document.h"
#include "scene/fbx_cameras.h"
#include "scene/import_camera.h"
#include "scene/import_lights.h"
#include "scene/import_materials.h"
#include "scene/import_meshes.h"
#include "scene/import_rehearsal.h"
#include "scene/model_format.h"
#include "scene/pane_or_body.h"
#include "scene/ply_strips.h"
#include "scene/readable_names.h"
#include "scene/upright.h"

namespace antipode {
namespace {

/// Opens regular files only, since a material library may name a pipe or a device, which never end.
class ModelIoSystem : public Assimp::DefaultIOSystem {
public:
    /// `text` stands for the content of the file at `path`, where it is not null.
    ModelIoSystem(std::string path, const std::string* text) : path_(std::move(path)), text_(text) {}

    bool Exists(const char* file) const override { return isRegularFile(file) && !isMaterialLibrary(file); }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (text_ && path_ == file)
            return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(text_->data()), text_->size());
        return Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
    }

private:
    /// Which are read by readObjLibraries().
    static bool isMaterialLibrary(const char* file) {
        const std::string extension = std::filesystem::path(file).extension().string();
        return extension == ".mtl" || extension == ".MTL" || extension == ".Mtl";
    }

    std::string path_;
    const std::string* text_;
};

/// Without this check Assimp tries all its importers on the first bytes and takes, for one, pictures for Wavefront OBJ.
void requireModelExtension(const Assimp::Importer& importer, const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (!importer.IsExtensionSupported(extension.c_str()))
        throw Error(ErrorCode::Input, "'" + extension +
                                          "' is not the extension of a model format that can be read; .glb, .gltf, "
                                          ".obj, .ply, .dae and .fbx are among those that can");
}

const aiScene& readFile(Assimp::Importer& importer, const std::string& path) {
    if (!importer.ReadFile(path, 0)) throw Error(ErrorCode::Input, importer.GetErrorString());
    checkIndices(*importer.GetScene());
    const aiScene* file = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (!file) throw Error(ErrorCode::Input, importer.GetErrorString());
    return *file;
}

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

/// Vertex colours stand for the colour that a material does not have: grey, which stands for none, becomes white under
/// them, and a texture takes their place, as in the programs that write both.
void settleVertexColors(Scene& scene) {
    size_t textured = 0;
    for (Mesh& mesh : scene.meshes) {
        if (mesh.colors.empty()) continue;
        Material& material = scene.materials[mesh.material];
        if (material.baseColorTexture) {
            mesh.colors.clear();
            ++textured;
        } else if (material.baseColor == Vec3f(kDefaultGrey)) {
            material.baseColor = Vec3f(1.0f);
        }
    }
    if (textured > 0)
        scene.notices.push_back("Vertex colours of " + std::to_string(textured) +
                                (textured == 1 ? " mesh" : " meshes") + " give way to a texture.");
}

ImportedModel importWithAssimp(const std::string& path, const ImportOptions& options) {
    const ModelFormat format = formatOf(path);
    std::optional<ColladaDocument> colladaFile;
    if (format == ModelFormat::Collada) colladaFile.emplace(path);
    const ColladaDocument* collada = colladaFile ? &*colladaFile : nullptr;
    std::optional<std::string> unstripped;
    if (format == ModelFormat::Ply) unstripped = plyWithFaces(path);
    const std::string* text = collada ? &collada->text() : unstripped ? &*unstripped : nullptr;
    Assimp::Importer importer;
    importer.SetIOHandler(new ModelIoSystem(path, text));                 // the importer owns it
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // no stand-in for what a file does not hold
    requireModelExtension(importer, path);
    // Only Assimp knows what is wrong with a file, and it may learn that by crashing.
    rehearseImport(path, [&] {
        readFile(importer, path);
        importer.FreeScene();
    });
    const aiScene& file = readFile(importer, path);

    ImportedModel model;
    standUpright(file, format, options);
    importMeshes(file, model.scene);
    const std::string directory = std::filesystem::path(path).parent_path().string();
    adoptMaterials(format == ModelFormat::Wavefront
                       ? importObjMaterials(file, path, options.strict, model.scene)
                       : importMaterials({file, format, collada}, directory, options.strict, model.scene),
                   model.scene);
    settleVertexColors(model.scene);
    importLights(file, format, collada, model.scene);
    const size_t parallelFbx = format == ModelFormat::Fbx ? countParallelFbxCameras(path) : 0;
    model.hasCamera = importCamera(file, {collada, parallelFbx}, options.camera, model.scene);
    return model;
}

ImportedModel importAny(const std::string& path, const ImportOptions& options) {
    if (!gltf::isGltfPath(path)) return importWithAssimp(path, options);
    try {
        return gltf::importFile(path, options);
    } catch (const gltf::FirstVersion&) {
        return importWithAssimp(path, options);
    }
}

/// `why` may quote the file, whatever its bytes are and however many.
[[noreturn]] void failToImport(const std::string& path, const std::string& why) {
    throw Error(ErrorCode::Input, "cannot import '" + path + "': " + readableText(why));
}

}  // namespace

ImportedModel importModelParts(const std::string& path, const ImportOptions& options) {
    requireRegularFile(path);
    try {
        ImportedModel model = importAny(path, options);
        model.scene.name = std::filesystem::path(path).stem().string();
        makeClosedGlassSolid(model.scene);
        makeNamesReadable(model.scene);
        foldNotices(model.scene.notices);
        return model;
    } catch (const Error& e) {
        failToImport(path, e.what());
    } catch (const std::bad_alloc&) {
        failToImport(path, "it asks for more memory than there is");
    } catch (const std::exception& e) {
        failToImport(path, e.what());
    }
}

Scene importModel(const std::string& path) { return importModel(path, ImportOptions{}); }

Scene importModel(const std::string& path, const ImportOptions& options) { return importModel(path, options, {}); }

Scene importModel(const std::string& path, const ImportOptions& options, const std::function<void(Scene&)>& change) {
    ImportedModel model = importModelParts(path, options);
    try {
        if (!model.hasCamera) {
            addDefaultCamera(model.scene);
        } else if (!options.camera && !seesSurfaces(model.scene)) {
            model.scene.camera = Camera{};
            addDefaultCamera(model.scene, "The file's camera shows next to nothing of its surfaces");
        } else if (!options.camera && isLeftOver(model.scene)) {
            model.scene.camera = Camera{};
            addDefaultCamera(model.scene,
                             "The file's camera is the one that Blender starts with and misses most of it");
        }
    } catch (const Error& e) {
        failToImport(path, e.what());
    }
    if (change) change(model.scene);
    try {
        addDefaultLight(model.scene, options.studio);
        validate(model.scene);
    } catch (const Error& e) {
        failToImport(path, e.what());
    }
    return std::move(model.scene);
}

}  // namespace antipode
