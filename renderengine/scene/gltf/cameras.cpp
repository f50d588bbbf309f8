#include "scene/gltf/cameras.h"

#include <algorithm>
#include <cmath>

#include "scene/camera_choice.h"

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

void readCamera(const Document& document, const Nodes& nodes, const PlacedCamera& placed, Scene& scene) {
    const json& from = entry(document.json, "cameras", placed.index);
    const json &perspective = object(from, "perspective"), &orthographic = object(from, "orthographic");
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
}

}  // namespace

bool importCamera(const Document& document, const Nodes& nodes, const std::optional<std::string>& wanted,
                  Scene& scene) {
    std::vector<PlacedCamera> cameras;
    std::vector<CameraName> names;
    for (const PlacedCamera& placed : placedCameras(document, nodes)) {
        const json& from = entry(document.json, "cameras", placed.index);
        if (object(from, "perspective").empty() && object(from, "orthographic").empty()) {
            scene.notices.push_back("Camera '" + nameOf(from, "camera", placed.index) +
                                    "' has neither a perspective nor a parallel projection and was left out.");
            continue;
        }
        cameras.push_back(placed);
        names.push_back({from.contains("name") ? nameOf(from, "camera", placed.index) : "",
                         nameOf(document.json["nodes"][placed.node], "node", placed.node)});
    }
    if (cameras.empty() && !wanted) return false;
    const PlacedCamera& chosen = cameras[chooseCamera(names, wanted, scene.notices)];
    readCamera(document, nodes, chosen, scene);
    return true;
}

}  // namespace antipode::gltf
