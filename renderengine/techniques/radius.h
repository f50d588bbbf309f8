// The merge radius: where it starts and how it shrinks.
#pragma once

#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode {

/// r_1 in scene units: settings.initialRadius where it is given, else radiusFactor times the smaller of the width that
/// a pixel covers at the scene's distance and 1/200 of the scene's bounding radius. Both scale with the scene.
double initialRadius(const Scene& scene, const RenderSettings& settings);

}  // namespace antipode
