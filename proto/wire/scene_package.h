// A scene as a tree of blobs: a root (farm.SceneRoot) that names the blobs of meshes, textures and environment map.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderengine/sha256.h"
#include "proto/farm.pb.h"
#include "renderengine/engine.h"
#include "renderengine/scene.h"

namespace antipode::wire {

/// A blob of at least one byte with its name.
struct Blob {
    farm::BlobRef reference;
    std::shared_ptr<const std::string> bytes;
};

struct ScenePackage {
    std::string sceneHash;    ///< sceneHash(scene)
    std::vector<Blob> blobs;  ///< the root first; equal blobs once
    const farm::BlobRef& root() const { return blobs.front().reference; }
};

/// A root may have so many bytes, and so many parts (part_count.h) within; 10^5 meshes take about 4 MB and 2·10^5
/// parts.
constexpr size_t maxSceneRootBytes = 16 << 20, maxSceneRootParts = 1 << 20;

/// Bytes of names that are no UTF-8 become question marks. Throws Error(Input) for an invalid scene, and for one whose
/// root would be too large.
ScenePackage packageScene(const Scene& scene);

/// Parses and checks a root: every list has its blob, every blob the size that its counts say, no file or helper shape
/// is in the skeleton. Throws Error(Input).
farm::SceneRoot parseSceneRoot(std::string_view bytes);

/// All blobs that a root names, each once.
std::vector<farm::BlobRef> blobsOf(const farm::SceneRoot& root);
/// Bytes of the skeleton and of all blobs, each as often as it is named: what the assembled scene takes.
uint64_t sceneBytes(const farm::SceneRoot& root);
/// What a job with this scene needs of a device, before anything is loaded. Throws Error(Usage) for invalid settings.
JobSize jobSize(const farm::SceneRoot& root, const farm::JobSettings& settings);

/// Puts the scene of a root that parseSceneRoot() gave together and validates it. `find` gives a blob's bytes, verified
/// by its hash, or nothing. Throws Error(Input).
Scene assembleScene(const farm::SceneRoot& root,
                    const std::function<std::shared_ptr<const std::string>(const farm::BlobRef&)>& find);

}  // namespace antipode::wire
