// What a camera sees, found out on the host before anything is built on a device.
#pragma once

#include <cstdint>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

struct PilotPaths {
    uint32_t paths = 0;  ///< traced
    /// For each path that met a surface on which vertices merge, in no order: the height that the whole field of view
    /// covers there, in scene units. Divided by the image's rows it is the width of a pixel.
    std::vector<double> pictureHeights;
};

/// Paths that start at points of an image of this aspect ratio (width over height), pass through specular surfaces the
/// way that carries more light, and end at the first surface that is not. Those that end in the background or at a
/// surface that neither reflects nor transmits meet nothing. Distances add up along a path: exact behind flat mirrors,
/// to first order behind curved ones. Textures, the holes in them and shading normals are not looked at.
///
/// Computed in double from the scene's floats by closest hits alone: the same on every machine, and × 2^k exactly for a
/// scene × 2^k. Takes a BVH, then some 10 µs a path. Throws Error as buildBvh().
PilotPaths tracePilotPaths(const Scene& scene, double aspectRatio);

}  // namespace antipode
