#include "scene/camera_choice.h"

#include <algorithm>

#include "renderengine/error.h"
#include "renderengine/io/suggest.h"

namespace antipode {
namespace {

/// What the camera is listed as: its own name where no other camera has it.
std::string shownName(const std::vector<CameraName>& cameras, size_t index) {
    const CameraName& one = cameras[index];
    const auto same = std::count_if(cameras.begin(), cameras.end(),
                                    [&](const CameraName& other) { return other.camera == one.camera; });
    return !one.node.empty() && (one.camera.empty() || same > 1) ? one.node : one.camera;
}

std::string listOf(const std::vector<CameraName>& cameras, size_t from) {
    constexpr size_t most = 16;
    std::vector<std::string> names;
    for (size_t i = from; i < cameras.size() && names.size() < most; ++i)
        names.push_back("'" + shownName(cameras, i) + "'");
    return joined(names) + (cameras.size() - from > most ? " …" : "");
}

}  // namespace

size_t chooseCamera(const std::vector<CameraName>& cameras, const std::optional<std::string>& wanted,
                    std::vector<std::string>& notices) {
    if (!wanted) {
        if (cameras.size() > 1)
            notices.push_back("The file has " + std::to_string(cameras.size()) + " cameras; the first, '" +
                              shownName(cameras, 0) + "', is used. --camera takes another: " + listOf(cameras, 1) +
                              ".");
        return 0;
    }
    for (size_t i = 0; i < cameras.size(); ++i)
        if (shownName(cameras, i) == *wanted) return i;
    for (size_t i = 0; i < cameras.size(); ++i)
        if (cameras[i].camera == *wanted || cameras[i].node == *wanted) return i;
    std::vector<std::string> names;
    for (size_t i = 0; i < cameras.size(); ++i) names.push_back(shownName(cameras, i));
    throw Error(ErrorCode::Input, "it has no camera '" + *wanted + "' (--camera); " +
                                      (cameras.empty() ? "it has none" : "its cameras are " + listOf(cameras, 0)) +
                                      "." + suggestion(*wanted, names));
}

}  // namespace antipode
