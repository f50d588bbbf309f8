// Which of a file's cameras is looked through.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace antipode {

struct CameraName {
    std::string camera, node;  ///< its own name, and that of the node which holds it
};

/// The index of the camera that is called `wanted`, or whose node is; the first without one, and a notice where there
/// are more. Throws Error(Input) that lists them where none has the name. `cameras` is not empty unless `wanted` is
/// given.
size_t chooseCamera(const std::vector<CameraName>& cameras, const std::optional<std::string>& wanted,
                    std::vector<std::string>& notices);

}  // namespace antipode
