// Whether the lights of a scene light it.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// False where the scene's own lights cannot light what its camera sees: of points on the surfaces inside the field of
/// view, drawn by area, fewer than a quarter receives light worth mention. That is bounded from above by what would
/// arrive straight from the lights if nothing stood between: from points, spots, suns and environments anything, from
/// emitting triangles what a white surface would show as a radiance of .01 or as a hundredth of the brightest
/// emitter's. Points that emit as much as they could reflect show themselves and do not count, so that unlit models
/// need no light; a glow on what has a colour of its own does. Textures count, holes do not.
/// Needs meshes and spheres whose materials exist, and textures of the sizes that they tell. Deterministic; takes
/// milliseconds.
bool lightsTheView(const Scene& scene);

}  // namespace antipode
