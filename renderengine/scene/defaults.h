// What a file without camera or light is given so that it can be looked at; each addition is said in `notices`.
#pragma once

#include <string>

#include "renderengine/import_options.h"

namespace antipode {

/// Places the camera so that the surfaces fill the view, seen a little from above and the side; outliers, beyond four
/// times the extent of 99 % of the vertices, do not count. In a closed room that is lit from inside it stands in a
/// corner. Without any surface the camera stays as it is. `why` begins the notice. Throws Error(Input) where floats
/// cannot hold such a camera.
void addDefaultCamera(Scene& scene, const std::string& why = "The file has no camera");

/// False where the camera shows next to nothing of the surfaces: what is in view of them, shadows aside, lies within a
/// rectangle of less than a thousandth of the image. Exporters leave the camera of an empty scene beside a model of
/// another size.
bool seesSurfaces(const Scene& scene);

/// True where the camera stands where Blender's startup file has it (before 2.80 or since), in whatever unit, and sees
/// less than half of the vertices: exporters write it beside models that were never seen through it.
bool isLeftOver(const Scene& scene);

/// Whether anything but surfaces emits: points, spots, suns, the sky.
bool hasLamps(const Scene& scene);

/// Whether anything emits. Needs meshes and spheres whose materials exist.
bool hasLight(const Scene& scene);

/// Adds the studio where the scene's own lights cannot light what the camera sees.
void addDefaultLight(Scene& scene, Studio studio);

}  // namespace antipode
