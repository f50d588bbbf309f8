#include "scene/import_camera.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/camera_choice.h"
#include "scene/import_nodes.h"

namespace antipode {
namespace {

/// Aspect ratios that ask for more are taken for broken.
constexpr double kMaxImportedWidth = 65536;

struct Lens {
    double verticalFov;             ///< radians
    double aspect;                  ///< width over height; 0 where the file does not tell
    double orthographicHeight = 0;  ///< of a parallel projection
};

struct PlacedCamera {
    const aiCamera& camera;
    Lens lens;
};

/// Nothing where the camera has no opening.
std::optional<Lens> readLens(const aiCamera& camera) {
    if (!(camera.mHorizontalFOV > 0)) return {};
    const double aspect = camera.mAspect > 0 ? camera.mAspect : 1;
    return Lens{2 * std::atan(std::tan(camera.mHorizontalFOV / 2) / aspect), camera.mAspect};
}

std::optional<Lens> readColladaLens(const ColladaDocument& collada, const aiCamera& camera) {
    const auto lens = collada.lens(camera.mName.C_Str());
    if (!lens) return readLens(camera);
    if (!(lens->verticalFov > 0 || lens->orthographicHeight > 0)) return {};
    return Lens{lens->verticalFov, lens->aspect, lens->orthographicHeight};
}

}  // namespace

bool importCamera(const aiScene& file, const CameraFacts& facts, const std::optional<std::string>& wanted,
                  Scene& scene) {
    std::vector<PlacedCamera> cameras;
    std::vector<CameraName> names;
    for (unsigned i = 0; i < file.mNumCameras; ++i) {
        const aiCamera& camera = *file.mCameras[i];
        const std::string name = camera.mName.C_Str();
        if (facts.parallelFbx >= file.mNumCameras) {
            scene.notices.push_back("Camera '" + name +
                                    "' has a parallel projection, which is not read from FBX; it was left out.");
            continue;
        }
        const auto lens = facts.collada ? readColladaLens(*facts.collada, camera) : readLens(camera);
        if (!lens) {
            scene.notices.push_back("Camera '" + name +
                                    "' has neither a perspective nor a parallel projection and was left out.");
            continue;
        }
        cameras.push_back({camera, *lens});
        names.push_back({name, ""});
    }
    if (cameras.empty() && !wanted) return false;
    if (facts.parallelFbx > 0 && !cameras.empty())
        scene.notices.push_back(std::to_string(facts.parallelFbx) +
                                " of the file's cameras have a parallel projection, which is not read from FBX; they "
                                "are taken for perspective ones.");
    const auto& [camera, lens] = cameras[chooseCamera(names, wanted, scene.notices)];
    const Affine toWorld = nodeToWorld(file, camera.mName.C_Str());
    scene.camera = Camera{};
    scene.camera.position = Vec3f(toWorld.point(toVec3d(camera.mPosition)));
    scene.camera.forward = Vec3f(normalize(toWorld.vector(toVec3d(camera.mLookAt))));
    scene.camera.up = Vec3f(normalize(toWorld.vector(toVec3d(camera.mUp))));
    if (lens.orthographicHeight > 0)
        scene.camera.orthographicHeight = float(lens.orthographicHeight);
    else
        scene.camera.verticalFov = float(lens.verticalFov);
    if (lens.aspect > 0)
        scene.imageWidth = uint32_t(std::clamp(std::round(scene.imageHeight * lens.aspect), 1.0, kMaxImportedWidth));
    return true;
}

}  // namespace antipode
