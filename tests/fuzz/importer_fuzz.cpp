// What an importing library may hand over: refused with an Error, or a scene that can be packed for a device. An input
// is read as numbers, not as a file: vertices, indices, materials, lights and transformations of any value. The library
// itself is not under test.
#include <assimp/ObjMaterial.h>
#include <assimp/scene.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <string>

#include "gpu/packed_scene.h"
#include "renderengine/error.h"
#include "scene/defaults.h"
#include "scene/import_camera.h"
#include "scene/import_lights.h"
#include "scene/import_materials.h"
#include "scene/import_meshes.h"
#include "tests/fuzz/require.h"

namespace antipode {
namespace {

/// Reads an input from front to back; zeros after its end.
class Input {
public:
    Input(const uint8_t* data, size_t size) : data_(data), size_(size) {}

    uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
    unsigned below(unsigned bound) { return byte() % bound; }
    bool flag() { return (byte() & 1) != 0; }
    /// Any bits at all.
    float real() {
        uint32_t bits = 0;
        for (int i = 0; i < 4; ++i) bits = (bits << 8) | byte();
        return std::bit_cast<float>(bits);
    }
    aiVector3D vector() {
        const float x = real(), y = real();
        return {x, y, real()};
    }
    aiColor3D color() {
        const float r = real(), g = real();
        return {r, g, real()};
    }
    aiMatrix4x4 matrix() {
        aiMatrix4x4 m;
        if (flag())
            for (unsigned row = 0; row < 3; ++row)
                for (unsigned column = 0; column < 4; ++column) m[row][column] = real();
        return m;
    }

private:
    const uint8_t* data_;
    size_t size_, at_ = 0;
};

aiMesh* readMesh(Input& in) {
    auto* mesh = new aiMesh;
    mesh->mName = "mesh";
    mesh->mMaterialIndex = in.below(4);
    mesh->mNumVertices = in.below(24);
    mesh->mVertices = new aiVector3D[mesh->mNumVertices];
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) mesh->mVertices[i] = in.vector();
    if (in.flag()) {
        mesh->mNormals = new aiVector3D[mesh->mNumVertices];
        for (unsigned i = 0; i < mesh->mNumVertices; ++i) mesh->mNormals[i] = in.vector();
    }
    if (in.flag()) {
        mesh->mTextureCoords[0] = new aiVector3D[mesh->mNumVertices];
        for (unsigned i = 0; i < mesh->mNumVertices; ++i) mesh->mTextureCoords[0][i] = in.vector();
    }
    mesh->mNumFaces = in.below(24);
    mesh->mFaces = new aiFace[mesh->mNumFaces];
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        aiFace& face = mesh->mFaces[i];
        // Mostly triangles; points, lines and what no triangulation left.
        const unsigned kind = in.below(16);
        face.mNumIndices = kind < 5 ? kind : 3;
        face.mIndices = new unsigned[face.mNumIndices];
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            const uint8_t index = in.byte();
            face.mIndices[k] = index == 255 ? 0xFFFFFFFFu : index;
        }
    }
    return mesh;
}

aiMaterial* readMaterial(Input& in) {
    auto* material = new aiMaterial;
    const aiColor3D diffuse = in.color(), specular = in.color(), emissive = in.color();
    material->AddProperty(&diffuse, 1, AI_MATKEY_COLOR_DIFFUSE);
    material->AddProperty(&specular, 1, AI_MATKEY_COLOR_SPECULAR);
    material->AddProperty(&emissive, 1, AI_MATKEY_COLOR_EMISSIVE);
    const float shininess = in.real(), ior = in.real(), opacity = in.real();
    material->AddProperty(&shininess, 1, AI_MATKEY_SHININESS);
    material->AddProperty(&ior, 1, AI_MATKEY_REFRACTI);
    material->AddProperty(&opacity, 1, AI_MATKEY_OPACITY);
    const int illumination = int8_t(in.byte());
    material->AddProperty(&illumination, 1, AI_MATKEY_OBJ_ILLUM);
    return material;
}

aiLight* readLight(Input& in) {
    auto* light = new aiLight;
    light->mName = in.flag() ? "child" : "nowhere";
    light->mType = aiLightSourceType(in.below(7));
    light->mPosition = in.vector();
    light->mDirection = in.vector();
    light->mColorDiffuse = in.color();
    light->mAngleInnerCone = in.real();
    light->mAngleOuterCone = in.real();
    return light;
}

aiCamera* readCamera(Input& in) {
    auto* camera = new aiCamera;
    camera->mName = in.flag() ? "child" : "nowhere";
    camera->mPosition = in.vector();
    camera->mLookAt = in.vector();
    camera->mUp = in.vector();
    camera->mHorizontalFOV = in.real();
    camera->mAspect = in.real();
    return camera;
}

aiNode* readNode(Input& in, const char* name) {
    auto* node = new aiNode(name);
    node->mTransformation = in.matrix();
    node->mNumMeshes = in.below(4);
    node->mMeshes = new unsigned[node->mNumMeshes];
    for (unsigned i = 0; i < node->mNumMeshes; ++i) node->mMeshes[i] = in.below(4);
    return node;
}

/// An array of `count` things, in the shape that aiScene deletes.
template <typename T>
T** readAll(unsigned count, T* (*read)(Input&), Input& in) {
    auto** all = new T*[count];
    for (unsigned i = 0; i < count; ++i) all[i] = read(in);
    return all;
}

std::unique_ptr<aiScene> readScene(Input& in) {
    auto file = std::make_unique<aiScene>();
    file->mNumMaterials = in.below(4);
    file->mMaterials = readAll(file->mNumMaterials, readMaterial, in);
    file->mNumLights = in.below(3);
    file->mLights = readAll(file->mNumLights, readLight, in);
    file->mNumCameras = in.below(2);
    file->mCameras = readAll(file->mNumCameras, readCamera, in);
    if (!in.flag()) {
        file->mRootNode = readNode(in, "root");
        aiNode* child = readNode(in, "child");
        file->mRootNode->addChildren(1, &child);
    }
    file->mNumMeshes = in.below(4);
    file->mMeshes = readAll(file->mNumMeshes, readMesh, in);
    return file;
}

/// As importModel does with what its library returned.
Scene importParts(const aiScene& file, ModelFormat format) {
    checkIndices(file);
    Scene scene;
    importMeshes(file, scene);
    const auto materials = importMaterials({file, format, nullptr}, "/nonexistent", false, scene);
    for (const auto& material : materials) scene.materials.push_back(material.value_or(Material{}));
    importLights(file, format, nullptr, scene);
    if (!importCamera(file, {}, std::nullopt, scene)) addDefaultCamera(scene);
    addDefaultLight(scene, Studio::Soft);
    validate(scene);
    return scene;
}

void tryModel(Input in) {
    constexpr ModelFormat formats[] = {ModelFormat::Fbx, ModelFormat::Stl, ModelFormat::Ply, ModelFormat::Other};
    const ModelFormat format = formats[in.below(4)];
    const Scene scene = importParts(*readScene(in), format);
    const PackedScene packed = packScene(scene);
    size_t primitives = scene.spheres.size();
    for (const Mesh& mesh : scene.meshes) primitives += mesh.triangles.size();
    require(packed.bvh.primitiveOrder.size() == primitives, "every triangle of a valid scene is packed");
    require(packed.lightCount > 0, "a valid scene has a light");
    for (size_t light = 0; light < packed.lightCount; ++light) {
        const auto chance = std::bit_cast<float>(packed.lights[light * shared::LIGHT_TEXELS].w);
        require(chance >= 0 && chance <= 1, "every light has a chance of being picked");
    }
}

}  // namespace
}  // namespace antipode

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    try {
        antipode::tryModel({data, size});
    } catch (const antipode::Error&) {
    }
    return 0;
}
