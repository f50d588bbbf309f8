// How bright a light makes what is close to it.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// The greatest irradiance that a point light, or a spot light were it to shine everywhere, gives a surface of the
/// scene: I·cosθ/d², occlusion and texture holes aside; `least` where none is greater. Looks at each primitive for each
/// light, closely only where that could exceed what was found before.
double brightestSpot(const Scene& scene, double least);

}  // namespace antipode
