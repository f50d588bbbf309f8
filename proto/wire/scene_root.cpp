// What can be known of a scene by its root alone.
#include <map>
#include <set>

#include "proto/scene_translation.h"
#include "proto/wire/job_messages.h"
#include "proto/wire/mesh_layout.h"
#include "proto/wire/part_count.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"

namespace antipode::wire {
namespace {

/// Above any memory, and small enough that sums and products of counts below it do not overflow.
constexpr uint64_t maxSceneBytes = uint64_t(1) << 42;
constexpr size_t sha256Bytes = 32;
constexpr uint64_t texelBytes = 4, mapValueBytes = 12;

void require(bool holds, const std::string& sentence) {
    if (!holds) throw Error(ErrorCode::Input, "the scene's root " + sentence);
}

/// width·height·bytesEach, where that is at least 1 and no more than a scene may have.
uint64_t imageBytes(uint32_t width, uint32_t height, uint64_t bytesEach) {
    const uint64_t count = uint64_t(width) * height;
    require(count >= 1 && count <= maxSceneBytes / bytesEach, "has an image without texels, or with too many");
    return count * bytesEach;
}

uint64_t texels(const farm::SceneRoot& root) {
    uint64_t count = 0;
    for (const schema::Texture& texture : root.skeleton().texture())
        count += uint64_t(texture.texels().width()) * texture.texels().height();
    const schema::EnvironmentMap& map = root.skeleton().environment().map();
    return count + uint64_t(map.width()) * map.height();
}

/// Adds up what the root names and sees that each name stands for one size.
class BlobCheck {
public:
    void add(const farm::BlobRef& blob, uint64_t bytes) {
        require(blob.sha256().size() == sha256Bytes, "names a blob by something other than a SHA-256");
        require(blob.size() == bytes, "names a blob of " + std::to_string(blob.size()) +
                                          " bytes where its counts say " + std::to_string(bytes));
        require(sizes_.emplace(blob.sha256(), bytes).first->second == bytes, "gives one blob two sizes");
        require(bytes <= maxSceneBytes - total_, "names more bytes than any machine holds");
        total_ += bytes;
    }

private:
    std::map<std::string, uint64_t> sizes_;
    uint64_t total_ = 0;
};

void checkSkeleton(const schema::Scene& skeleton) {
    fromProto(skeleton);  // refuses files, helper shapes and names that lead nowhere
    for (const schema::Mesh& mesh : skeleton.mesh())
        require(mesh.positions().empty() && mesh.normals().empty() && mesh.uvs().empty() && mesh.triangles().empty() &&
                    mesh.more_uvs().empty() && mesh.colors().empty() && mesh.tangents().empty() &&
                    !mesh.has_transform(),
                "has a mesh that is not empty");
    for (const schema::Texture& texture : skeleton.texture())
        require(texture.texels().rgba().empty(), "has a texture that is not empty");
    require(skeleton.environment().map().rgb().empty(), "has an environment map that is not empty");
}

void checkBlobs(const farm::SceneRoot& root) {
    BlobCheck blobs;
    int64_t meshes = 0;
    for (const farm::MeshBlob& mesh : root.mesh()) {
        uint64_t bytes = 0;
        for (const farm::MeshCounts& counts : mesh.mesh()) {
            require(counts.vertices() >= 1 && counts.triangles() >= 1, "has a mesh without vertices or triangles");
            require(counts.more_uv_sets() <= mostFurtherUvSets, "has a mesh with more than 16 sets of uvs");
            bytes += meshBytes(counts);
        }
        require(bytes >= 1, "has a blob without meshes");
        blobs.add(mesh.blob(), bytes);
        meshes += mesh.mesh_size();
    }
    const schema::Scene& skeleton = root.skeleton();
    require(meshes == skeleton.mesh_size(), "does not have blobs for exactly its meshes");
    require(root.texture_size() == skeleton.texture_size(), "does not have blobs for exactly its textures");
    for (int i = 0; i < root.texture_size(); ++i) {
        const schema::Texels& size = skeleton.texture(i).texels();
        blobs.add(root.texture(i), imageBytes(size.width(), size.height(), texelBytes));
    }
    require(root.has_environment() == skeleton.environment().has_map(),
            "does not have a blob for exactly its environment map");
    if (!root.has_environment()) return;
    const schema::EnvironmentMap& size = skeleton.environment().map();
    blobs.add(root.environment(), imageBytes(size.width(), size.height(), mapValueBytes));
}

template <class Use>
void forEachBlob(const farm::SceneRoot& root, Use use) {
    for (const farm::MeshBlob& mesh : root.mesh()) use(mesh.blob());
    for (const farm::BlobRef& texture : root.texture()) use(texture);
    if (root.has_environment()) use(root.environment());
}

}  // namespace

farm::SceneRoot parseSceneRoot(std::string_view bytes) {
    require(bytes.size() <= maxSceneRootBytes, "has more bytes than a root may have");
    require(partCount(bytes, *farm::SceneRoot::descriptor(), maxSceneRootParts) <= maxSceneRootParts,
            "has more parts than a root may have");
    farm::SceneRoot root;
    require(root.ParseFromArray(bytes.data(), int(bytes.size())), "cannot be parsed");
    checkSkeleton(root.skeleton());
    checkBlobs(root);
    return root;
}

std::vector<farm::BlobRef> blobsOf(const farm::SceneRoot& root) {
    std::vector<farm::BlobRef> blobs;
    std::set<std::string_view> known;
    forEachBlob(root, [&](const farm::BlobRef& blob) {
        if (known.insert(blob.sha256()).second) blobs.push_back(blob);
    });
    return blobs;
}

uint64_t sceneBytes(const farm::SceneRoot& root) {
    uint64_t bytes = root.skeleton().ByteSizeLong();
    forEachBlob(root, [&](const farm::BlobRef& blob) { bytes += blob.size(); });
    return bytes;
}

JobSize jobSize(const farm::SceneRoot& root, const farm::JobSettings& message) {
    const RenderSettings settings = fromMessage(message);
    JobSize size = sizeOf(settings);
    for (const farm::MeshBlob& blob : root.mesh())
        for (const farm::MeshCounts& mesh : blob.mesh()) size.triangles += mesh.triangles();
    size.spheres = uint64_t(root.skeleton().sphere_size());
    size.texels = texels(root);
    return size;
}

}  // namespace antipode::wire
