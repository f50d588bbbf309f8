// What a file without camera or light is given so that it can be looked at; each addition is said in `notices`.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// Places the camera so that the bounding box of all surfaces fills the view, seen a little from above and the side.
/// Without any surface the camera stays as it is. Throws Error(Input) where floats cannot hold such a camera.
void addDefaultCamera(Scene& scene);

/// Whether anything emits. Needs meshes and spheres whose materials exist.
bool hasLight(const Scene& scene);

/// Adds a constant environment of radiance 1 unless something emits already.
void addDefaultLight(Scene& scene);

}  // namespace antipode
