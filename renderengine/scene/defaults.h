// What a file without camera or light is given so that it can be looked at; each addition is said in `notices`.
#pragma once

#include "renderengine/import_options.h"

namespace antipode {

/// Places the camera so that the surfaces fill the view, seen a little from above and the side; outliers, beyond four
/// times the extent of 99 % of the vertices, do not count. In a closed room that is lit from inside it stands in a
/// corner. Without any surface the camera stays as it is. Throws Error(Input) where floats cannot hold such a camera.
void addDefaultCamera(Scene& scene);

/// Whether anything but surfaces emits: points, spots, suns, the sky.
bool hasLamps(const Scene& scene);

/// Whether anything emits. Needs meshes and spheres whose materials exist.
bool hasLight(const Scene& scene);

/// Adds the studio where the scene's own lights cannot light what the camera sees.
void addDefaultLight(Scene& scene, Studio studio);

}  // namespace antipode
