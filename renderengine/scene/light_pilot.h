// Whether the lights of a scene light it.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// False where the scene's own lights cannot light what its camera sees: of points on the surfaces inside the field of
/// view, drawn by area, fewer than one in fifty receives light worth mention. That is bounded from above by what would
/// arrive straight from the lights if nothing stood between: from points, spots, suns and environments anything, from
/// emitting triangles what a white surface would show as a radiance of .01 or as a hundredth of the brightest
/// emitter's. True as well where half of the surfaces seen are emitters: unlit models show themselves.
/// Needs meshes and spheres whose materials exist. Deterministic; takes milliseconds.
bool lightsTheView(const Scene& scene);

}  // namespace antipode
