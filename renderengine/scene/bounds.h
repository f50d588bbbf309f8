// How far surfaces reach, in scene units and double precision.
#pragma once

#include "numerics/bounds.h"
#include "renderengine/scene.h"

namespace antipode {

/// Of all positions, those that no triangle uses included.
Bounds3d boundsOf(const Mesh& mesh);
Bounds3d boundsOf(const Sphere& sphere);
/// Of all meshes and spheres.
Bounds3d boundsOf(const Scene& scene);

}  // namespace antipode
