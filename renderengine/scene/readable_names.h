// Names and notices of scenes, as people and other machines may see them.
#pragma once

#include "renderengine/scene.h"

namespace antipode {

/// Makes all names (200 bytes) and notices of a scene readable text: they stand in messages, go over the wire and into
/// the output's metadata.
void makeNamesReadable(Scene& scene);

}  // namespace antipode
