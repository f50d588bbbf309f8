#include "scene/gltf/cameras.h"

#include <algorithm>
#include <cmath>

namespace antipode::gltf {
namespace {

/// Aspect ratios that ask for more are taken for broken.
constexpr double kMaxImportedWidth = 65536;

struct PlacedCamera {
    size_t index, node;
};

/// In the order of the file's cameras; of one that several nodes hold, those in the order of nodes.
std::vector<PlacedCamera> placedCameras(const Document& document, const Nodes& nodes) {
    std::vector<PlacedCamera> cameras;
    for (size_t node : nodes.shown)
        if (const auto index = reference(document.json["nodes"][node], "camera")) cameras.push_back({*index, node});
    std::stable_sort(cameras.begin(), cameras.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
    return cameras;
}

}  // namespace

bool importCamera(const Document& document, const Nodes& nodes, Scene& scene) {
    const std::vector<PlacedCamera> cameras = placedCameras(document, nodes);
    for (const PlacedCamera& placed : cameras) {
        const json& from = entry(document.json, "cameras", placed.index);
        const json &perspective = object(from, "perspective"), &orthographic = object(from, "orthographic");
        if (perspective.empty() && orthographic.empty()) {
            scene.notices.push_back("Camera '" + nameOf(from, "camera", placed.index) +
                                    "' has neither a perspective nor a parallel projection and was left out.");
            continue;
        }
        const Affine& toWorld = nodes.toWorld[placed.node];
        scene.camera = Camera{};
        scene.camera.position = Vec3f(toWorld.offset);
        scene.camera.forward = Vec3f(normalize(-toWorld.z));
        scene.camera.up = Vec3f(normalize(toWorld.y));
        double aspect = perspective.value("aspectRatio", 0.0);
        if (orthographic.empty()) {
            scene.camera.verticalFov = perspective.at("yfov").get<float>();
        } else {
            // Half of what is seen; signs and zeros stand in files whose camera nobody looked through.
            const double halfWidth = std::abs(orthographic.at("xmag").get<double>());
            const double halfHeight = std::abs(orthographic.at("ymag").get<double>());
            scene.camera.orthographicHeight = float(2 * halfHeight);
            aspect = halfHeight > 0 ? halfWidth / halfHeight : 0;
            if (!(halfHeight > 0)) fail("camera '" + nameOf(from, "camera", placed.index) + "' shows nothing");
        }
        if (aspect > 0)
            scene.imageWidth = uint32_t(std::clamp(std::round(scene.imageHeight * aspect), 1.0, kMaxImportedWidth));
        if (cameras.size() > 1)
            scene.notices.push_back("The file has " + std::to_string(cameras.size()) + " cameras; the first is used.");
        return true;
    }
    return false;
}

}  // namespace antipode::gltf
