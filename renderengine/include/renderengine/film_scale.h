// The scales of a job's film, without a device.
#pragma once

#include "renderengine/film_layout.h"
#include "renderengine/scene.h"

namespace antipode {

/// The layers of the job's film with the scales that an Engine has for the scene: who asks others to render can tell
/// what their sums must look like. Prepares the scene as an Engine does, hierarchy of bounds included. `settings` as
/// for an Engine. Throws Error.
FilmLayout scaledFilmLayout(const Scene& scene, const RenderSettings& settings);

}  // namespace antipode
