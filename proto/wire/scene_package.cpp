#include "proto/wire/scene_package.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>

#include "proto/scene_loader.h"
#include "proto/scene_translation.h"
#include "proto/wire/mesh_layout.h"
#include "proto/wire/part_count.h"
#include "renderengine/error.h"
#include "renderengine/io/text.h"

namespace antipode::wire {
namespace {

/// Meshes share a blob up to this size, so that a scene of very many small ones needs few blobs.
constexpr uint64_t sharedBlobBytes = 1 << 20;

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Moves the next `count` values out of the bytes.
template <class T>
void take(std::string_view& bytes, size_t count, std::vector<T>& values) {
    if (count == 0) return;
    values.resize(count);
    std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
}

/// The blobs of a package, equal ones once. The root comes first, but is known last.
class BlobList {
public:
    BlobList() : blobs_(1) {}

    const farm::BlobRef& add(std::string bytes) {
        Blob blob = makeBlob(std::move(bytes));
        const auto [entry, isNew] = indices_.emplace(blob.reference.sha256(), blobs_.size());
        if (isNew) blobs_.push_back(std::move(blob));
        return blobs_[entry->second].reference;
    }

    std::vector<Blob> finish(std::string root) {
        blobs_[0] = makeBlob(std::move(root));
        return std::move(blobs_);
    }

private:
    static Blob makeBlob(std::string bytes) {
        Blob blob;
        blob.reference.set_sha256(sha256Of(bytes));
        blob.reference.set_size(bytes.size());
        blob.bytes = std::make_shared<const std::string>(std::move(bytes));
        return blob;
    }

    std::vector<Blob> blobs_;
    std::map<std::string, size_t> indices_;
};

farm::MeshCounts countsOf(const Mesh& mesh) {
    constexpr size_t most = std::numeric_limits<uint32_t>::max();
    if (mesh.positions.size() > most || mesh.triangles.size() > most)
        throw Error(ErrorCode::Input, "mesh '" + mesh.name + "' has more than 2^32 vertices or triangles; divide it");
    farm::MeshCounts counts;
    counts.set_vertices(uint32_t(mesh.positions.size()));
    counts.set_normals(!mesh.normals.empty());
    counts.set_uvs(!mesh.uvs.empty());
    counts.set_triangles(uint32_t(mesh.triangles.size()));
    const size_t sets = mesh.moreUvs.size() / mesh.positions.size();
    if (sets > mostFurtherUvSets)
        throw Error(ErrorCode::Input,
                    "mesh '" + mesh.name + "' has more than 16 sets of uvs; leave out what no texture uses");
    counts.set_more_uv_sets(uint32_t(sets));
    counts.set_colors(!mesh.colors.empty());
    counts.set_tangents(!mesh.tangents.empty());
    return counts;
}

void packMeshes(const std::vector<Mesh>& meshes, farm::SceneRoot& root, BlobList& blobs) {
    for (size_t i = 0; i < meshes.size();) {
        farm::MeshBlob* shared = root.add_mesh();
        std::string bytes;
        for (; i < meshes.size(); ++i) {
            const Mesh& mesh = meshes[i];
            const farm::MeshCounts counts = countsOf(mesh);
            if (!bytes.empty() && bytes.size() + meshBytes(counts) > sharedBlobBytes) break;
            bytes.reserve(bytes.size() + meshBytes(counts));
            append(bytes, mesh.positions), append(bytes, mesh.normals), append(bytes, mesh.uvs);
            append(bytes, mesh.moreUvs), append(bytes, mesh.colors), append(bytes, mesh.tangents);
            append(bytes, mesh.triangles);
            *shared->add_mesh() = counts;
        }
        *shared->mutable_blob() = blobs.add(std::move(bytes));
    }
}

/// Protobuf's strings must be UTF-8; names of scenes that no loader has made need not.
void repairNames(schema::Scene& skeleton) {
    const auto repair = [](std::string* name) { *name = readableText(*name); };
    repair(skeleton.mutable_name());
    for (schema::Texture& texture : *skeleton.mutable_texture()) repair(texture.mutable_name());
    for (schema::Material& material : *skeleton.mutable_material()) repair(material.mutable_name());
    for (schema::Mesh& mesh : *skeleton.mutable_mesh()) repair(mesh.mutable_name());
    for (std::string& notice : *skeleton.mutable_notice()) repair(&notice);
}

using FindBlob = std::function<std::shared_ptr<const std::string>(const farm::BlobRef&)>;

std::shared_ptr<const std::string> bytesOf(const farm::BlobRef& blob, const FindBlob& find) {
    auto bytes = find(blob);
    if (!bytes || bytes->size() != blob.size())
        throw Error(ErrorCode::Input, "blob " + hexadecimal(blob.sha256()) + " of the scene is missing");
    return bytes;
}

void unpackMeshes(const farm::SceneRoot& root, const FindBlob& find, std::vector<Mesh>& meshes) {
    size_t next = 0;
    for (const farm::MeshBlob& shared : root.mesh()) {
        const auto bytes = bytesOf(shared.blob(), find);
        std::string_view rest = *bytes;
        for (const farm::MeshCounts& counts : shared.mesh()) {
            Mesh& mesh = meshes.at(next++);
            take(rest, counts.vertices(), mesh.positions);
            take(rest, counts.normals() ? counts.vertices() : 0, mesh.normals);
            take(rest, counts.uvs() ? counts.vertices() : 0, mesh.uvs);
            take(rest, size_t(counts.more_uv_sets()) * counts.vertices(), mesh.moreUvs);
            take(rest, counts.colors() ? counts.vertices() : 0, mesh.colors);
            take(rest, counts.tangents() ? counts.vertices() : 0, mesh.tangents);
            take(rest, counts.triangles(), mesh.triangles);
        }
    }
}

}  // namespace

ScenePackage packageScene(const Scene& scene) {
    validate(scene);
    BlobList blobs;
    farm::SceneRoot root;
    *root.mutable_skeleton() = toProto(scene, Arrays::LeftOut);
    repairNames(*root.mutable_skeleton());
    packMeshes(scene.meshes, root, blobs);
    for (const Texture& texture : scene.textures)
        *root.add_texture() = blobs.add({texture.rgba.begin(), texture.rgba.end()});
    if (scene.environment && !scene.environment->map.empty()) {
        std::string bytes;
        append(bytes, scene.environment->map);
        *root.mutable_environment() = blobs.add(std::move(bytes));
    }
    std::string bytes = root.SerializeAsString();
    if (bytes.size() > maxSceneRootBytes ||
        partCount(bytes, *farm::SceneRoot::descriptor(), maxSceneRootParts) > maxSceneRootParts)
        throw Error(
            ErrorCode::Input,
            "the scene has too many meshes, materials or lights to be sent to servers; join meshes that have the "
            "same material, or render it on this machine alone");
    return {sceneHash(scene), blobs.finish(std::move(bytes))};
}

Scene assembleScene(const farm::SceneRoot& root, const FindBlob& find) {
    Scene scene = fromProto(root.skeleton());
    unpackMeshes(root, find, scene.meshes);
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        const auto bytes = bytesOf(root.texture(int(i)), find);
        scene.textures[i].rgba.assign(bytes->begin(), bytes->end());
    }
    if (root.has_environment()) {
        const auto bytes = bytesOf(root.environment(), find);
        std::string_view rest = *bytes;
        take(rest, rest.size() / sizeof(Vec3f), scene.environment->map);
    }
    validate(scene);
    return scene;
}

}  // namespace antipode::wire
