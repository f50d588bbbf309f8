// Light for models that bring none.
#pragma once

#include "renderengine/import_options.h"

namespace antipode {

/// Replaces the environment by that of the studio; in soft and sun, adds a ground below the surfaces unless the camera
/// stands below that, too. Does not say so. The camera decides where the key light is: to the left of it, and above.
void addStudio(Scene& scene, Studio studio);

}  // namespace antipode
