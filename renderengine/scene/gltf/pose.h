// A glTF file's first animation at one time.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/document.h"

namespace antipode::gltf {

/// What an animation says of a node; the rest stands as the file has it.
struct NodePose {
    std::optional<std::array<double, 3>> translation, scale;
    std::optional<std::array<double, 4>> rotation;  ///< x, y, z, w
    std::optional<std::vector<double>> weights;     ///< of morph targets
};

/// Of the nodes that the file's first animation moves, their poses at a time in seconds; before its first key and after
/// its last it stands still. Steps, linear (rotations along great circles) and cubic splines (glTF 2.0, appendix C).
/// Several animations are a notice. Throws Error(Input).
std::map<size_t, NodePose> poseAt(const Document& document, double seconds, std::vector<std::string>& notices);

}  // namespace antipode::gltf
