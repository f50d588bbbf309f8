// What single precision does to positions: in scenes far from the origin, to small things in large ones.
#pragma once

#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

/// One sentence for each thing that a scene's floats cannot show well: positions that are rounded by a visible part of
/// a pixel, the object whose shape suffers most where that is more than a thousandth of its size, and triangles so
/// large that hits on them are rounded by more than a hundredth of the smallest object.
std::vector<std::string> precisionNotices(const Scene& scene);

}  // namespace antipode
