#include "scene/import_camera.h"

#include <algorithm>
#include <cmath>

#include "scene/import_nodes.h"

namespace antipode {
namespace {

/// Aspect ratios that ask for more are taken for broken.
constexpr double kMaxImportedWidth = 65536;

struct Lens {
    double verticalFov;  ///< radians
    double aspect;       ///< width over height; 0 where the file does not tell
};

/// Nothing for orthographic cameras.
std::optional<Lens> readGltfLens(const GltfDocument& gltf, const std::string& nodeName) {
    const auto node = gltf.find("nodes", nodeName);
    if (!node) return {};
    const nlohmann::json& camera = gltf.json.at("cameras").at(gltf.json["nodes"][*node].at("camera").get<size_t>());
    if (!camera.contains("perspective")) return {};
    const nlohmann::json& perspective = camera["perspective"];
    return Lens{perspective.at("yfov").get<double>(), perspective.value("aspectRatio", 0.0)};
}

std::optional<Lens> readAssimpLens(const aiCamera& camera) {
    if (!(camera.mHorizontalFOV > 0)) return {};
    const double aspect = camera.mAspect > 0 ? camera.mAspect : 1;
    return Lens{2 * std::atan(std::tan(camera.mHorizontalFOV / 2) / aspect), camera.mAspect};
}

}  // namespace

bool importCamera(const aiScene& file, const GltfDocument* gltf, Scene& scene) {
    for (unsigned i = 0; i < file.mNumCameras; ++i) {
        const aiCamera& camera = *file.mCameras[i];
        const std::string name = camera.mName.C_Str();
        const auto lens = gltf ? readGltfLens(*gltf, name) : readAssimpLens(camera);
        if (!lens) {
            scene.notices.push_back("Camera '" + name + "' is not a perspective camera and was left out.");
            continue;
        }
        const Affine toWorld = nodeToWorld(file, name);
        scene.camera = Camera{};
        // For glTF, Assimp repeats the node's translation in the camera, where it would count twice.
        scene.camera.position = Vec3f(toWorld.point(gltf ? Vec3d() : toVec3d(camera.mPosition)));
        scene.camera.forward = Vec3f(normalize(toWorld.vector(toVec3d(camera.mLookAt))));
        scene.camera.up = Vec3f(normalize(toWorld.vector(toVec3d(camera.mUp))));
        scene.camera.verticalFov = float(lens->verticalFov);
        if (lens->aspect > 0)
            scene.imageWidth =
                uint32_t(std::clamp(std::round(scene.imageHeight * lens->aspect), 1.0, kMaxImportedWidth));
        if (file.mNumCameras > 1)
            scene.notices.push_back("The file has " + std::to_string(file.mNumCameras) +
                                    " cameras; the first is used.");
        return true;
    }
    return false;
}

}  // namespace antipode
