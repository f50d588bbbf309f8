// Small valid scenes: one that holds little, and those that hold everything.
#pragma once

#include "renderengine/scene.h"

namespace antipode::testing {

/// One emitting triangle and one grey sphere.
Scene smallScene();
/// Every field differs from its default.
Scene fullScene();
/// The same with a second texture and four meshes: with positions alone, with everything, without and with only uvs.
Scene richScene();

}  // namespace antipode::testing
